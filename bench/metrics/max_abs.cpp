#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::optional<double> max_abs(const Image& reference, const Image& test) {
    const Reduction most = reduce_finite(
        reference, test, [](double r, double v) { return std::abs(v - r); }, kMax);
    if (most.values == 0) return {};
    return most.value;
}

}  // namespace

extern const Metric metric_max_abs{
    .key = "max_abs", .summary = "largest absolute difference of one channel", .measure = max_abs};

}  // namespace lightsweep
