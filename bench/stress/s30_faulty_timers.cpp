// Timers that lie in every way that drivers have been seen to lie: a query that returns 0, a constant, the time of the
// last tile, of the submission, a wrapped or stalling counter. The self-test refuses each, says why, and chooses none
// of them; it still believes an honest clock beside them.
#include "bench/stress/case.h"
#include "bench/stress/faulty_timers.h"

namespace lightsweep {
namespace {

constexpr TimerEffort kEffort{.unit_ns = 1'000'000, .repetitions = 2};
// Noise passes, a lie stays: an honest clock that is refused is asked again.
constexpr int kTrials = 4;
constexpr const char* kHonest = "finish_clock";

StressTrial begin(Workbench&, const StressArm&) {
    return [](double) {
        std::vector<std::string> wrong;
        bool honest_is_believed = false;
        for (int trial = 0; trial < kTrials && !honest_is_believed && wrong.empty(); ++trial) {
            auto timers = faulty_timers();
            timers.push_back({kHonest, make_frame_timer(kHonest)});
            auto reports = test_timers(std::move(timers), kEffort);
            honest_is_believed = reports.back().accepted;
            reports.pop_back();
            wrong = wrong_verdicts(reports);
        }
        if (!honest_is_believed && wrong.empty()) wrong.emplace_back("the honest clock is refused");
        return StressMeasurement{.error = static_cast<double>(wrong.size()),
                                 .where = wrong.empty() ? std::string() : wrong.front()};
    };
}

std::vector<ArmBlock> arms() { return {ArmBlock{}}; }

}  // namespace

extern const StressCase stress_faulty_timers{
    .id = "S30",
    .summary = "timers that return 0, a constant, half, that wrap, stall, or stop before the work is done",
    .measures = "faulty timers that the self-test believes or would choose, and an honest one that it does not",
    .unit = "count",
    .bound = 0.0,
    .bound_source = "a time that is wrong is worse than none",
    .failure = "a table of times that never happened",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
