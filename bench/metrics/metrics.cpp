#include "bench/metrics/metrics.h"

#include "renderer/base/error.h"

#include <fmt/format.h>

namespace lightsweep {

extern const Metric metric_rmse, metric_psnr_db, metric_max_abs, metric_mrse, metric_nonfinite_px;

std::span<const Metric* const> all_metrics() {
    static constexpr const Metric* kMetrics[] = {
        &metric_rmse, &metric_psnr_db, &metric_max_abs, &metric_mrse, &metric_nonfinite_px,
    };
    return kMetrics;
}

void require_comparable(const Image& reference, const Image& test) {
    if (reference.width != test.width || reference.height != test.height)
        throw InputError(
            fmt::format("the images differ in size: reference {}x{}, test {}x{}; both must have the same size",
                        reference.width, reference.height, test.width, test.height));
    const auto word = [](ColorSpace space) { return space == ColorSpace::linear ? "linear" : "display"; };
    if (reference.space != test.space)
        throw InputError(
            fmt::format("the images differ in kind: reference holds {} values, test {} values; both must hold "
                        "the same kind",
                        word(reference.space), word(test.space)));
}

}  // namespace lightsweep
