#include "bench/stats/block_bootstrap.h"

#include "bench/stats/autocorrelation.h"
#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace lightsweep {
namespace {

using Distribution = std::vector<double>;  ///< [k]: the probability of the count k

/// Of how many of `length` neighbours on the ring, from a start taken at random, hold.
Distribution count_in_block(const std::vector<char>& holds, size_t length) {
    const size_t n = holds.size();
    Distribution counts(length + 1);
    size_t count = 0;
    for (size_t i = 0; i < length; ++i) count += holds[i] != 0;
    for (size_t start = 0; start < n; ++start) {
        counts[count] += 1 / static_cast<double>(n);
        count += static_cast<size_t>(holds[(start + length) % n]);
        count -= static_cast<size_t>(holds[start]);
    }
    return counts;
}

/// Of the sum of two independent counts.
Distribution convolve(const Distribution& a, const Distribution& b) {
    Distribution sum(a.size() + b.size() - 1);
    for (size_t j = 0; j < b.size(); ++j) {
        if (b[j] == 0) continue;
        for (size_t i = 0; i < a.size(); ++i) sum[i + j] += a[i] * b[j];
    }
    return sum;
}

/// The probability that at least half of a resample holds; a resample is n samples in blocks, the last cut short.
double half_holds(const std::vector<char>& holds, size_t block) {
    const size_t n = holds.size();
    const Distribution one = count_in_block(holds, block);
    Distribution sum = count_in_block(holds, n % block);
    for (size_t i = 0; i < n / block; ++i) sum = convolve(sum, one);
    return std::reduce(sum.begin() + static_cast<std::ptrdiff_t>((n + 1) / 2), sum.end());
}

double normal_cdf(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

/// The z that `tail` of a normal distribution lies above; 0 < tail < 1/2.
double normal_upper(double tail) {
    double low = 0, high = 40;
    while (std::nextafter(low, high) < high) {
        const double z = std::midpoint(low, high);
        (normal_cdf(-z) > tail ? low : high) = z;
    }
    return high;
}

/// The tail to cut from the resamples of `blocks` blocks so that the interval is as wide as Student's t would make it.
/// t from z by the expansion in Abramowitz and Stegun, 26.7.5.
double expanded_tail(double tail, double blocks) {
    const double z = normal_upper(tail), z2 = z * z, nu = blocks - 1;
    const double t = z * (1 + (z2 + 1) / (4 * nu) + ((5 * z2 + 16) * z2 + 3) / (96 * nu * nu) +
                          (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * nu * nu * nu));
    return normal_cdf(-t * std::sqrt(blocks / nu));
}

}  // namespace

size_t block_length(std::span<const double> samples) {
    const auto n = static_cast<double>(samples.size());
    const double time = n / effective_sample_size(sides_of_median(samples));
    const double rho = (time - 1) / (time + 1);  // of the autoregression whose time is (1 + rho) / (1 - rho)
    const double g = 2 * rho / (1 - rho * rho);  // sum of |k| rho^|k| over its sum of rho^|k|
    const double length = std::cbrt(1.5 * g * g * n);
    return static_cast<size_t>(std::clamp(std::ceil(length), 1.0, std::max(1.0, std::floor(n / 2))));
}

Interval block_median_interval(std::span<const double> samples, size_t block, double level) {
    CHECK_THAT(block >= 1 && block <= samples.size() / 2, "block = {}, samples = {}", block, samples.size());
    CHECK_THAT(level > 0 && level < 1, "level = {}", level);
    const double tail =
        expanded_tail((1 - level) / 2, static_cast<double>(samples.size()) / static_cast<double>(block));
    std::vector<double> sorted(samples.begin(), samples.end());
    std::ranges::sort(sorted);
    std::vector<char> holds(samples.size());
    const auto half = [&](auto condition) {
        std::ranges::transform(samples, holds.begin(), [&](double v) { return static_cast<char>(condition(v)); });
        return half_holds(holds, block);
    };
    // The largest sample that a resample's median falls short of in at most a tail's share, and its mirror image.
    const auto below = [&](double x) { return half([x](double v) { return v < x; }) <= tail; };
    const auto above = [&](double x) { return half([x](double v) { return v > x; }) > tail; };
    const auto low = std::ranges::partition_point(sorted, below);
    const auto high = std::ranges::partition_point(sorted, above);
    return {.estimate = median(samples), .low = *std::prev(low), .high = *high};
}

}  // namespace lightsweep
