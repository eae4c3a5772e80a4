// Mean relative squared error: ((v - r) / (r + 0.01))^2 on linear values, so that an error weighs as it would be seen
// against its own brightness. Rousselle, Knaus, Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error
// Minimization", SIGGRAPH Asia 2011, with their epsilon. Radiance below zero, which only a fault produces, counts by
// its size.
#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::vector<std::optional<double>> mrse(const ImagePair& pair) {
    const auto term = [](double r, double v) {
        const double relative = (v - r) / (std::abs(r) + 0.01);
        return relative * relative;
    };
    const Reduction sum = reduce_finite(pair.reference_linear, pair.test_linear, term, kSum);
    if (sum.values == 0) return {std::nullopt};
    return {sum.value / static_cast<double>(sum.values)};
}

constexpr std::string_view kValues[] = {"mrse"};

}  // namespace

extern const Metric metric_mrse{
    .key = "mrse", .summary = "mean relative squared difference of linear values", .values = kValues, .measure = mrse};

}  // namespace lightsweep
