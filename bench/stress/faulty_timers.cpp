#include "bench/stress/faulty_timers.h"

#include "renderer/base/error.h"

#include <functional>

namespace lightsweep {
namespace {

// The honest clock with a lie on top: the fault is planted, the rest is real.
class LyingTimer final : public FrameTimer {
  public:
    /// Of the true time, of when the frame ended, and of how many frames there were before.
    using Lie = std::function<int64_t(int64_t true_ns, int64_t end_ns, int frame)>;
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
        times.total_ns = lie_(times.total_ns, end_ns_, frame_++);
        return times;
    }

  private:
    Lie lie_;
    std::unique_ptr<FrameTimer> honest_;
    int64_t end_ns_ = 0;
    int frame_ = 0;
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

// Both ends of the interval kept in 18 bits of nanoseconds, as 32 would be for some thousand times longer work.
int64_t wrapped(int64_t ns, int64_t end_ns) {
    const int64_t mask = (int64_t{1} << 18) - 1;
    return (end_ns & mask) - ((end_ns - ns) & mask);
}

}  // namespace

std::vector<TimerUnderTest> faulty_timers() {
    std::vector<TimerUnderTest> timers;
    const auto add = [&](const char* name, LyingTimer::Lie lie) {
        timers.push_back({name, std::make_unique<LyingTimer>(std::move(lie))});
    };
    add("zero", [](int64_t, int64_t, int) { return int64_t{0}; });
    add("constant", [](int64_t, int64_t, int) { return int64_t{3'000'000}; });
    add("half", [](int64_t ns, int64_t, int) { return ns / 2; });
    add("last_tile", [](int64_t ns, int64_t, int) { return ns / 40; });
    add("negative", [](int64_t ns, int64_t, int) { return -ns; });
    add("wrapped", [](int64_t ns, int64_t end_ns, int) { return wrapped(ns, end_ns); });
    // A counter that stands still in every third frame, and one that is a second ahead in every fifth.
    add("stalled", [](int64_t ns, int64_t, int frame) { return frame % 3 == 0 ? ns / 10 : ns; });
    add("jumping", [](int64_t ns, int64_t, int frame) { return frame % 5 == 0 ? ns + 1'000'000'000 : ns; });
    timers.push_back({"submission", std::make_unique<SubmitTimer>()});
    return timers;
}

std::vector<std::string> wrong_verdicts(const std::vector<TimerMethodReport>& of_faulty) {
    std::vector<std::string> wrong;
    for (const TimerMethodReport& report : of_faulty) {
        if (report.accepted) {
            wrong.push_back(report.method + " is believed");
        } else if (report.why.empty()) {
            wrong.push_back(report.method + " is refused without a reason");
        }
    }
    try {
        wrong.push_back(choose_timer(of_faulty).method + " is chosen");
    } catch (const EnvironmentError& refusal) {
        if (std::string_view(refusal.what()).empty()) wrong.emplace_back("refused without a word");
    }
    return wrong;
}

}  // namespace lightsweep
