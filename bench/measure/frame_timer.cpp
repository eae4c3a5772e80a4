#include "bench/measure/frame_timer.h"

#include "renderer/base/check.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/query.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace lightsweep {
namespace {

FrameTimes from_passes(int64_t total_ns, std::vector<int64_t> passes_ns) {
    const int64_t sum = std::accumulate(passes_ns.begin(), passes_ns.end(), int64_t{0});
    return {total_ns, std::move(passes_ns), total_ns - sum};
}

class ElapsedTimer final : public FrameTimer {
  public:
    void begin_frame(size_t pass_count) override {
        count_ = pass_count;
        while (queries_.size() < count_) queries_.emplace_back();
    }
    void begin_pass(size_t index) override { queries_[index].begin(); }
    void end_pass(size_t index) override { queries_[index].end(); }
    void end_frame() override {}
    FrameTimes take() override {
        std::vector<int64_t> passes;
        for (size_t i = 0; i < count_; ++i) passes.push_back(static_cast<int64_t>(queries_[i].wait_ns()));
        const int64_t total = std::accumulate(passes.begin(), passes.end(), int64_t{0});
        return from_passes(total, std::move(passes));
    }

  private:
    std::vector<gl::ElapsedQuery> queries_;
    size_t count_ = 0;
};

// Marks are taken in the order: frame begins, (pass begins, pass ends) ..., frame ends.
template <class Mark>
FrameTimes from_marks(size_t pass_count, Mark mark_ns) {
    std::vector<int64_t> passes;
    for (size_t i = 0; i < pass_count; ++i) passes.push_back(mark_ns(2 + 2 * i) - mark_ns(1 + 2 * i));
    return from_passes(mark_ns(1 + 2 * pass_count) - mark_ns(0), std::move(passes));
}

class TimestampTimer final : public FrameTimer {
  public:
    explicit TimestampTimer(bool flush) : flush_(flush) {}
    void begin_frame(size_t pass_count) override {
        count_ = pass_count;
        while (queries_.size() < 2 + 2 * count_) queries_.emplace_back();
        next_ = 0;
        mark();
    }
    void begin_pass(size_t) override { mark(); }
    void end_pass(size_t) override { mark(); }
    void end_frame() override { mark(); }
    FrameTimes take() override {
        // A counter may stand anywhere and wrap; differences in 64 bits are right all the same.
        return from_marks(count_, [&](size_t i) { return static_cast<int64_t>(queries_[i].wait_ns()); });
    }

  private:
    void mark() {
        if (flush_) gl::flush();
        queries_[next_++].record();
        if (flush_) gl::flush();
    }
    bool flush_;
    std::vector<gl::TimestampQuery> queries_;
    size_t count_ = 0;
    size_t next_ = 0;
};

class FinishTimer final : public FrameTimer {
  public:
    void begin_frame(size_t pass_count) override {
        count_ = pass_count;
        marks_.clear();
        mark();
    }
    void begin_pass(size_t) override { mark(); }
    void end_pass(size_t) override { mark(); }
    void end_frame() override { mark(); }
    FrameTimes take() override {
        return from_marks(count_, [&](size_t i) { return marks_[i]; });
    }

  private:
    void mark() {
        gl::finish();
        marks_.push_back(now_ns());
    }
    std::vector<int64_t> marks_;
    size_t count_ = 0;
};

}  // namespace

const std::vector<std::string>& timer_methods() {
    static const std::vector<std::string> methods = {"time_elapsed", "timestamp", "timestamp_flush", "finish_clock"};
    return methods;
}

std::unique_ptr<FrameTimer> make_frame_timer(const std::string& method) {
    if (method == "time_elapsed") return std::make_unique<ElapsedTimer>();
    if (method == "timestamp") return std::make_unique<TimestampTimer>(false);
    if (method == "timestamp_flush") return std::make_unique<TimestampTimer>(true);
    CHECK_THAT(method == "finish_clock", "{}", method);
    return std::make_unique<FinishTimer>();
}

int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace lightsweep
