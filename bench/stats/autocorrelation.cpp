#include "bench/stats/autocorrelation.h"

#include "bench/stats/quantile.h"
#include "renderer/base/check.h"

#include <algorithm>
#include <numeric>

namespace lightsweep {

double effective_sample_size(std::span<const double> samples) {
    CHECK(!samples.empty());
    const size_t count = samples.size();
    const auto n = static_cast<double>(count);
    constexpr size_t kFewest = 10;
    if (count < kFewest) return n;
    const double mean = std::reduce(samples.begin(), samples.end()) / n;
    const auto autocovariance = [&](size_t lag) {
        double sum = 0;
        for (size_t i = 0; i + lag < count; ++i) sum += (samples[i] - mean) * (samples[i + lag] - mean);
        return sum / n;
    };
    const double variance = autocovariance(0);
    if (variance <= 0) return n;
    double time = -1;  // 1 + 2 sum of rho(k > 0), as 2 (rho(0) + rho(1)) + 2 (rho(2) + rho(3)) + ... - 1
    for (size_t lag = 0; lag + 1 < count; lag += 2) {
        const double pair = (autocovariance(lag) + autocovariance(lag + 1)) / variance;
        if (pair <= 0) break;
        time += 2 * pair;
    }
    return std::clamp(n / std::max(time, 1.0), 1.0, n);
}

std::vector<double> sides_of_median(std::span<const double> samples) {
    const double middle = median(samples);
    std::vector<double> sides(samples.size());
    std::ranges::transform(samples, sides.begin(),
                           [&](double v) { return v < middle ? -1.0 : static_cast<double>(v > middle); });
    return sides;
}

}  // namespace lightsweep
