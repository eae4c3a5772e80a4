#include "bench/cli/progress.h"

#include "bench/measure/frame_timer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace lightsweep {
namespace {

constexpr size_t kBarWidth = 30;
constexpr int64_t kRedrawNs = 100'000'000;

std::string duration_text(double seconds) {
    const int whole = static_cast<int>(std::max(0.0, seconds) + 0.5);
    return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar(size_t group_count, std::optional<double> budget_s, std::string word)
    : terminal_(isatty(STDERR_FILENO) != 0),
      count_(group_count),
      budget_s_(budget_s),
      word_(std::move(word)),
      start_ns_(now_ns()) {}

void ProgressBar::update(size_t index, double fraction, const std::string& group) {
    const int64_t now = now_ns();
    if (!terminal_ || now - drawn_ns_ < kRedrawNs) return;
    drawn_ns_ = now;
    const double done = (static_cast<double>(index) + std::clamp(fraction, 0.0, 1.0)) / static_cast<double>(count_);
    const double elapsed = static_cast<double>(now - start_ns_) * 1e-9;
    double left = elapsed / std::max(done, 1e-3) - elapsed;
    if (budget_s_) left = std::min(left, *budget_s_ - elapsed);
    const auto filled = static_cast<size_t>(done * kBarWidth);
    fmt::print(stderr, "\r\x1b[K[{}{}] {:3.0f} %  {} {}/{}  {} left  {}", std::string(filled, '='),
               std::string(kBarWidth - filled, ' '), 100.0 * done, word_, index + 1, count_, duration_text(left),
               group);
    std::fflush(stderr);
}

void ProgressBar::finish_group(size_t index, const std::string& line) {
    if (!terminal_) fmt::print(stderr, "[{}/{}] {}\n", index + 1, count_, line);
}

void ProgressBar::clear() {
    if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

}  // namespace lightsweep
