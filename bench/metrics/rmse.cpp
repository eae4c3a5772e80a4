#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::optional<double> rmse(const Image& reference, const Image& test) {
    const Reduction sum = reduce_finite(reference, test, kSquaredDifference, kSum);
    if (sum.values == 0) return {};
    return std::sqrt(sum.value / static_cast<double>(sum.values));
}

}  // namespace

extern const Metric metric_rmse{
    .key = "rmse", .summary = "root of the mean squared difference over all channels", .measure = rmse};

}  // namespace lightsweep
