#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::vector<std::optional<double>> max_abs(const ImagePair& pair) {
    const Reduction most = reduce_finite(
        pair.hdr ? pair.reference_linear : pair.reference_display, pair.hdr ? pair.test_linear : pair.test_display,
        [](double r, double v) { return std::abs(v - r); }, kMax);
    if (most.values == 0) return {std::nullopt};
    return {most.value};
}

constexpr std::string_view kValues[] = {"max_abs"};

}  // namespace

extern const Metric metric_max_abs{
    .key = "max_abs",
    .summary = "largest difference of one channel: linear values if the reference is linear, else display values",
    .values = kValues,
    .measure = max_abs};

}  // namespace lightsweep
