// Mean relative squared error: ((v - r) / (r + 0.01))^2 on linear values, so that an error weighs as it would be seen
// against its own brightness. Rousselle, Knaus, Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error
// Minimization", SIGGRAPH Asia 2011, with their epsilon. Radiance below zero, which only a fault produces, counts by
// its size.
#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::optional<double> mrse(const Image& reference, const Image& test) {
    if (reference.space != ColorSpace::linear)
        return mrse(converted(reference, ColorSpace::linear), converted(test, ColorSpace::linear));
    const auto term = [](double r, double v) {
        const double relative = (v - r) / (std::abs(r) + 0.01);
        return relative * relative;
    };
    const Reduction sum = reduce_finite(reference, test, term, kSum);
    if (sum.values == 0) return {};
    return sum.value / static_cast<double>(sum.values);
}

}  // namespace

extern const Metric metric_mrse{
    .key = "mrse", .summary = "mean relative squared difference of linear values", .measure = mrse};

}  // namespace lightsweep
