// Timer and sample queries. Nothing here says that the timers tell the truth: bench/measure proves that first.
#pragma once

#include "renderer/gl/handle.h"

#include <cstdint>

namespace lightsweep::gl {

namespace detail {
void delete_query(unsigned id);
}

/// GL_TIMESTAMP: the GPU's clock when everything before it is done.
class TimestampQuery {
  public:
    TimestampQuery();
    void record() const;
    uint64_t wait_ns() const;  ///< blocks until it is there; 64 bits

  private:
    Handle<detail::delete_query> handle_;
};

/// GL_TIME_ELAPSED around work. Does not nest.
class ElapsedQuery {
  public:
    ElapsedQuery();
    void begin() const;
    void end() const;
    uint64_t wait_ns() const;

  private:
    Handle<detail::delete_query> handle_;
};

/// GL_SAMPLES_PASSED around draws: how many fragments passed all their tests.
class SamplesQuery {
  public:
    SamplesQuery();
    void begin() const;
    void end() const;
    uint64_t wait_count() const;

  private:
    Handle<detail::delete_query> handle_;
};

}  // namespace lightsweep::gl
