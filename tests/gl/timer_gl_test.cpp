// The self-test must find every timer that lies, on a real context with real work.
#include "bench/measure/known_work.h"
#include "bench/measure/self_test.h"
#include "bench/stress/faulty_timers.h"
#include "renderer/gl/draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

TEST(TimerSelfTest, RefusesEveryPlantedFault) {
    auto timers = faulty_timers();
    timers.push_back({"honest", make_frame_timer("finish_clock")});  // no further attempts once it is accepted
    auto reports = test_timers(std::move(timers), {.unit_ns = 1'000'000, .repetitions = 2});
    reports.pop_back();
    EXPECT_THAT(wrong_verdicts(reports), testing::IsEmpty());
}

TEST(TimerSelfTest, EveryTimerSeesEveryPass) {
    KnownWork work;
    work.calibrate(200'000);
    for (const auto& method : timer_methods()) {
        const auto timer = make_frame_timer(method);
        for (size_t kind = 0; kind < work_kinds().size(); ++kind) {
            work.issue(kind, 1, *timer);
            gl::finish();
            const FrameTimes times = timer->take();
            EXPECT_EQ(times.passes_ns.size(), static_cast<size_t>(work_kinds()[kind].passes)) << method;
            int64_t sum = times.unattributed_ns;
            for (const int64_t pass : times.passes_ns) sum += pass;
            EXPECT_EQ(sum, times.total_ns) << method;
        }
    }
}

}  // namespace
}  // namespace lightsweep
