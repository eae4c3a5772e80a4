#include "bench/stats/quantile.h"

#include "bench/stats/autocorrelation.h"
#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lightsweep {
namespace {

/// The largest rank k (from 1) such that the k-th smallest of `count` independent samples lies above the median with a
/// probability of at most `tail`; 0 when not even the smallest does: P(Binomial(count, 1/2) < k) <= tail.
size_t low_rank(size_t count, double tail) {
    const auto n = static_cast<double>(count);
    double below = 0;
    for (size_t k = 0; k < count; ++k) {
        const auto i = static_cast<double>(k);
        below += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) - n * std::numbers::ln2);
        if (below > tail) return k;
    }
    return count;
}

}  // namespace

double quantile(std::span<const double> samples, double fraction) {
    CHECK(!samples.empty());
    CHECK_THAT(fraction >= 0 && fraction <= 1, "fraction = {}", fraction);
    std::vector<double> values(samples.begin(), samples.end());
    const double position = fraction * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::ptrdiff_t>(position);
    const auto at = values.begin() + below;
    std::nth_element(values.begin(), at, values.end());
    const double weight = position - static_cast<double>(below);
    if (weight == 0) return *at;
    return std::lerp(*at, *std::min_element(at + 1, values.end()), weight);
}

double median(std::span<const double> samples) { return quantile(samples, 0.5); }

Interval median_interval(std::span<const double> samples, double level) {
    CHECK_THAT(level > 0 && level < 1, "level = {}", level);
    Interval interval{.estimate = median(samples), .low = {}, .high = {}};
    const auto effective = static_cast<size_t>(effective_sample_size(sides_of_median(samples)));
    const size_t rank = low_rank(effective, (1 - level) / 2);
    if (rank == 0) return interval;
    // The distance of that rank from the middle grows with the samples that each effective one stands for.
    const auto n = static_cast<double>(samples.size());
    const auto m = static_cast<double>(effective);
    const double from_middle = ((m + 1) / 2 - static_cast<double>(rank)) * (n / m);
    const auto low = static_cast<size_t>(std::floor((n + 1) / 2 - from_middle));
    std::vector<double> sorted(samples.begin(), samples.end());
    std::ranges::sort(sorted);
    interval.low = sorted[low - 1];
    interval.high = sorted[sorted.size() - low];
    return interval;
}

double level_for_each(double level, size_t comparisons) {
    CHECK(comparisons > 0);
    return 1 - (1 - level) / static_cast<double>(comparisons);
}

}  // namespace lightsweep
