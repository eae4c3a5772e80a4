// What `execute` tells a clock. The clocks themselves live with the measuring; a path does not know of them.
#pragma once

#include <cstddef>

namespace lightsweep {

/// Called on the thread that draws, in this order: begin_frame, (begin_pass, end_pass) for each pass, end_frame.
class PassTimer {
  public:
    virtual ~PassTimer() = default;
    virtual void begin_frame(size_t pass_count) = 0;
    virtual void begin_pass(size_t index) = 0;
    virtual void end_pass(size_t index) = 0;
    virtual void end_frame() = 0;
};

/// Times nothing.
class NoTimer final : public PassTimer {
  public:
    void begin_frame(size_t) override {}
    void begin_pass(size_t) override {}
    void end_pass(size_t) override {}
    void end_frame() override {}
};

}  // namespace lightsweep
