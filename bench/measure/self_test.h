// Proves which timer tells the truth on this device, at start-up, before anything is measured with it.
//
// The method: known work of several kinds (known_work.h), 1, 2 and 4 units of it, is timed by every method in turn. The
// yardstick is the steady clock with glFinish before and after the very same frame, so that a busy machine slows both.
// A method is accepted when for every kind of work all but one in fifty of its shares of the yardstick lie within
// [kLowestRatio, kHighestRatio] on either side (right on average is not right), its times are linear in the amount (or
// as linear as the yardstick's), and no single time was impossible (negative, or longer than the clock saw). The first
// accepted one in the order given (cheapest first) is used. No driver is believed or refused by its name. When nothing
// is accepted, repetitions are added: noise passes, a lie stays.
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

/// One kind of work, as measured: for each amount the repetitions, in the order taken.
struct TimerTrial {
    std::string kind;
    std::vector<int64_t> target_px;
    int framebuffers = 1;
    std::vector<int64_t> amounts;
    std::vector<std::vector<int64_t>> yardstick_ns;  ///< [amount][repetition]: the clock around the same frame
    std::vector<std::vector<int64_t>> measured_ns;   ///< [amount][repetition]
};

/// The verdict on one method, from its trials alone. Pure.
TimerMethodReport judge_timer(const std::string& method, const std::vector<TimerTrial>& trials);

/// How much work the trials are made of.
struct TimerEffort {
    int64_t unit_ns = 2'500'000;  ///< long against a clock's and a glFinish's own cost (some tens of microseconds)
    int repetitions = 9;
};

/// Runs the trials on the current context and judges each timer.
std::vector<TimerMethodReport> test_timers(std::vector<TimerUnderTest> timers, TimerEffort effort = {});

/// The first accepted method of `methods`; or `forced`, whatever they say, when it is not empty. Throws
/// EnvironmentError when there is none. Pure.
TimerReport choose_timer(std::vector<TimerMethodReport> methods, const std::string& forced = {});

}  // namespace lightsweep
