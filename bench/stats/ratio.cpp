#include "bench/stats/ratio.h"

#include "bench/stats/autocorrelation.h"
#include "bench/stats/block_bootstrap.h"
#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lightsweep {
namespace {

constexpr double kFewestForBootstrap = 20;

}  // namespace

std::optional<PairedRatio> ratio_of_pairs(std::span<const double> a, std::span<const double> b, double level) {
    CHECK_THAT(a.size() == b.size(), "{} and {} samples", a.size(), b.size());
    const auto is_time = [](double v) { return v > 0 && std::isfinite(v); };
    if (a.empty() || !std::ranges::all_of(a, is_time) || !std::ranges::all_of(b, is_time)) return {};

    std::vector<double> logs(a.size());
    std::ranges::transform(a, b, logs.begin(), [](double x, double y) { return std::log(x) - std::log(y); });
    const double effective = effective_sample_size(sides_of_median(logs));
    const Interval interval = effective < kFewestForBootstrap ? median_interval(logs, level)
                                                              : block_median_interval(logs, block_length(logs), level);
    PairedRatio result{.ratio = {.estimate = std::exp(interval.estimate), .low = {}, .high = {}},
                       .pairs = logs.size(),
                       .effective_count = effective};
    if (interval.low) result.ratio.low = std::exp(*interval.low);
    if (interval.high) result.ratio.high = std::exp(*interval.high);
    return result;
}

std::string_view word(Verdict verdict) {
    constexpr std::string_view kWords[] = {"faster", "slower", "same", "ambiguous"};
    return kWords[static_cast<size_t>(verdict)];
}

Verdict verdict(const Interval& ratio, double floor) {
    CHECK_THAT(floor >= 0, "floor = {}", floor);
    const double low = ratio.low.value_or(0);
    const double high = ratio.high.value_or(std::numeric_limits<double>::infinity());
    if (high < 1 / (1 + floor)) return Verdict::faster;
    if (low > 1 + floor) return Verdict::slower;
    if (low >= 1 / (1 + floor) && high <= 1 + floor) return Verdict::same;
    return Verdict::ambiguous;
}

}  // namespace lightsweep
