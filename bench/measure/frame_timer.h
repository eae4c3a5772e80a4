// The ways to time a frame's passes on the GPU. Which of them tells the truth here is for self_test.h to prove.
#pragma once

#include "renderer/pass/pass_timer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lightsweep {

/// The passes and `unattributed_ns` sum to `total_ns`.
struct FrameTimes {
    int64_t total_ns = 0;
    std::vector<int64_t> passes_ns;
    int64_t unattributed_ns = 0;  ///< between passes, before the first, after the last
};

class FrameTimer : public PassTimer {
  public:
    /// The last frame's times. Blocks until the GPU has them.
    virtual FrameTimes take() = 0;
};

/// The methods, cheapest first: the order in which an accepted one is preferred.
///   time_elapsed     GL_TIME_ELAPSED around each pass; what is between passes is not seen
///   timestamp        GL_TIMESTAMP at each border
///   timestamp_flush  the same with glFlush around each, so that a tiling driver cannot bin them together
///   finish_clock     the steady clock with glFinish at each border
const std::vector<std::string>& timer_methods();

/// `method` must be one of timer_methods().
std::unique_ptr<FrameTimer> make_frame_timer(const std::string& method);

/// The steady clock.
int64_t now_ns();

}  // namespace lightsweep
