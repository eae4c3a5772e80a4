#include "bench/metrics/metrics.h"

namespace lightsweep {

extern const Metric metric_rmse, metric_psnr_db, metric_max_abs, metric_max_rel, metric_mrse, metric_percentiles,
    metric_ssim, metric_flip, metric_nonfinite_px;

std::span<const Metric* const> all_metrics() {
    static constexpr const Metric* kMetrics[] = {
        &metric_rmse,        &metric_psnr_db, &metric_max_abs, &metric_max_rel,      &metric_mrse,
        &metric_percentiles, &metric_ssim,    &metric_flip,    &metric_nonfinite_px,
    };
    return kMetrics;
}

std::vector<std::string_view> metric_value_keys() {
    std::vector<std::string_view> keys;
    for (const Metric* metric : all_metrics()) keys.insert(keys.end(), metric->values.begin(), metric->values.end());
    return keys;
}

}  // namespace lightsweep
