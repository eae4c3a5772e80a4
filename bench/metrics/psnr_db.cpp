// PSNR = 10 log10(peak^2 / MSE) (ITU-T J.247, annex on PSNR), of display values, whose peak is 1.
#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <cmath>

namespace lightsweep {
namespace {

std::vector<std::optional<double>> psnr_db(const ImagePair& pair) {
    const Reduction sum = reduce_finite(pair.reference_display, pair.test_display, kSquaredDifference, kSum);
    if (sum.value == 0) return {std::nullopt};
    return {10 * std::log10(static_cast<double>(sum.values) / sum.value)};
}

constexpr std::string_view kValues[] = {"psnr_db"};

}  // namespace

extern const Metric metric_psnr_db{.key = "psnr_db",
                                   .summary = "peak signal to noise ratio of display values; none without a difference",
                                   .values = kValues,
                                   .measure = psnr_db};

}  // namespace lightsweep
