#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::vector<std::optional<double>> rmse(const ImagePair& pair) {
    const Reduction sum = reduce_finite(pair.reference_display, pair.test_display, kSquaredDifference, kSum);
    if (sum.values == 0) return {std::nullopt};
    return {std::sqrt(sum.value / static_cast<double>(sum.values))};
}

constexpr std::string_view kValues[] = {"rmse"};

}  // namespace

extern const Metric metric_rmse{.key = "rmse",
                                .summary = "root of the mean squared difference of display values",
                                .values = kValues,
                                .measure = rmse};

}  // namespace lightsweep
