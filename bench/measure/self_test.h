// Proves which timer tells the truth on this device, at start-up, before anything is measured with it.
//
// The method: known work of several kinds (known_work.h), 1, 2 and 4 units of it, is timed by every method and by the
// yardstick, the steady clock with glFinish before and after. Yardstick and methods take turns, and the fastest of the
// repetitions counts, which is what the work takes when nothing disturbs it. A method is accepted when for every kind
// of work the sum of its times over the amounts is within [kLowestRatio, kHighestRatio] of the yardstick's, its times
// are linear in the amount, and no single time was impossible (negative, or longer than the clock saw). The first
// accepted one in the order given (cheapest first) is used. No driver is believed or refused by its name. When a busy
// machine spoils the trials so that nothing is accepted, repetitions are added: noise passes, a lie stays.
#pragma once

#include "bench/measure/frame_timer.h"
#include "bench/report/record.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lightsweep {

inline constexpr double kLowestRatio = 0.90;
inline constexpr double kHighestRatio = 1.05;
inline constexpr double kLowestLinearity = 0.99;  ///< R^2 of time over amount

struct TimerUnderTest {
    std::string method;
    std::unique_ptr<FrameTimer> timer;
};

/// The methods of timer_methods().
std::vector<TimerUnderTest> all_timers();

/// One kind of work, as measured: for each amount the repetitions of the yardstick and of a method, in the order taken.
struct TimerTrial {
    std::string kind;
    std::vector<int64_t> target_px;
    int framebuffers = 1;
    std::vector<int64_t> amounts;
    std::vector<std::vector<int64_t>> yardstick_ns;  ///< [amount][repetition]
    std::vector<std::vector<int64_t>> measured_ns;   ///< [amount][repetition]
    std::vector<std::vector<int64_t>> wall_ns;       ///< the clock around each of `measured_ns`: it cannot be longer
};

/// The verdict on one method, from its trials alone. Pure.
TimerMethodReport judge_timer(const std::string& method, const std::vector<TimerTrial>& trials);

/// Runs the trials on the current context and judges. `forced`: use this method whatever comes out, and say so.
/// Throws EnvironmentError when no method is accepted and none is forced.
TimerReport run_timer_self_test(std::vector<TimerUnderTest> timers, const std::string& forced = {});

/// The first accepted method of `methods`, or `forced`. Throws EnvironmentError when there is none. Pure.
TimerReport choose_timer(std::vector<TimerMethodReport> methods, const std::string& forced);

}  // namespace lightsweep
