// The self-test must find every timer that lies, on a real context with real work.
#include "bench/measure/known_work.h"
#include "bench/measure/self_test.h"
#include "renderer/base/error.h"
#include "renderer/gl/draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace lightsweep {
namespace {

// The honest clock with a lie on top: the defect is planted, the rest is real.
class LyingTimer final : public FrameTimer {
  public:
    using Lie = std::function<int64_t(int64_t true_ns, int64_t end_ns)>;
    explicit LyingTimer(Lie lie) : lie_(std::move(lie)), honest_(make_frame_timer("finish_clock")) {}
    void begin_frame(size_t passes) override { honest_->begin_frame(passes); }
    void begin_pass(size_t i) override { honest_->begin_pass(i); }
    void end_pass(size_t i) override { honest_->end_pass(i); }
    void end_frame() override {
        honest_->end_frame();
        end_ns_ = now_ns();
    }
    FrameTimes take() override {
        FrameTimes times = honest_->take();
        times.total_ns = lie_(times.total_ns, end_ns_);
        return times;
    }

  private:
    Lie lie_;
    std::unique_ptr<FrameTimer> honest_;
    int64_t end_ns_ = 0;
};

// The clock of whoever submits: it stops before the GPU has begun.
class SubmitTimer final : public FrameTimer {
  public:
    void begin_frame(size_t) override { begin_ns_ = now_ns(); }
    void begin_pass(size_t) override {}
    void end_pass(size_t) override {}
    void end_frame() override { end_ns_ = now_ns(); }
    FrameTimes take() override { return {end_ns_ - begin_ns_, {}, end_ns_ - begin_ns_}; }

  private:
    int64_t begin_ns_ = 0, end_ns_ = 0;
};

TEST(TimerSelfTest, RefusesEveryPlantedFault) {
    const auto lying = [](LyingTimer::Lie lie) { return std::make_unique<LyingTimer>(std::move(lie)); };
    std::vector<TimerUnderTest> timers;
    timers.push_back({"zero", lying([](int64_t, int64_t) { return int64_t{0}; })});
    timers.push_back({"half", lying([](int64_t ns, int64_t) { return ns / 2; })});
    timers.push_back({"constant", lying([](int64_t, int64_t) { return int64_t{3'000'000}; })});
    timers.push_back({"last_tile", lying([](int64_t ns, int64_t) { return ns / 40; })});
    // Both ends of the interval kept in 22 bits of nanoseconds, as 32 would be for a thousand times longer work.
    timers.push_back({"wrapped", lying([](int64_t ns, int64_t end) {
                          const int64_t mask = (1 << 22) - 1;
                          return (end & mask) - ((end - ns) & mask);
                      })});
    timers.push_back({"submission", std::make_unique<SubmitTimer>()});
    timers.push_back({"honest", make_frame_timer("finish_clock")});
    for (const auto& method : test_timers(std::move(timers))) {
        if (method.method == "honest") continue;
        EXPECT_FALSE(method.accepted) << method.method << ": " << method.why;
        EXPECT_THAT(method.why, testing::Not(testing::IsEmpty()));
    }
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
