// PSNR = 10 log10(peak^2 / MSE) (ITU-T J.247, annex on PSNR). The peak of display values is 1. Radiance has no upper
// end: its peak is the largest value of the reference, so that the number does not change with the exposure.
#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::optional<double> psnr_db(const Image& reference, const Image& test) {
    const Reduction sum = reduce_finite(reference, test, kSquaredDifference, kSum);
    const double peak = reference.space == ColorSpace::display
                            ? 1.0
                            : reduce_finite(
                                  reference, test, [](double r, double) { return r; }, kMax)
                                  .value;
    if (sum.value == 0 || peak == 0) return {};
    return 10 * std::log10(peak * peak * static_cast<double>(sum.values) / sum.value);
}

}  // namespace

extern const Metric metric_psnr_db{
    .key = "psnr_db", .summary = "peak signal to noise ratio; nothing when there is no difference", .measure = psnr_db};

}  // namespace lightsweep
