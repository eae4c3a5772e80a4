#include "bench/report/time_error.h"

#include "bench/report/pairs.h"

namespace lightsweep {

std::string error_key(std::string_view metric) { return "reference.display." + std::string(metric); }

std::vector<TimeErrorPoint> time_error_points(const GroupResult& group, std::string_view metric) {
    std::vector<TimeErrorPoint> points;
    for (const CellResult* cell : competitors(group)) {
        if (!cell->error || !cell->error->reference) continue;
        const auto value = cell->error->reference->display.value(metric);
        if (!value) continue;
        const std::vector<double> wall_ns(cell->samples.wall_ns.begin(), cell->samples.wall_ns.end());
        TimeErrorPoint point{.cell = cell,
                             .time_ns = median_interval(wall_ns, kIntervalLevel),
                             .error = {.estimate = *value, .low = {}, .high = {}}};
        if (metric == kErrorMetric) {
            point.error.low = cell->error->flip_mean_low;
            point.error.high = cell->error->flip_mean_high;
        }
        points.push_back(point);
    }
    return points;
}

}  // namespace lightsweep
