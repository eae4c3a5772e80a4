// Time against error: the arms of a group as points, each coordinate with its interval. Pure functions of samples.
#pragma once

#include "bench/report/record.h"

#include "bench/stats/quantile.h"

#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

/// The error of the report's fronts, among the numbers of CellError::reference's display picture.
inline constexpr const char* kErrorMetric = "flip_mean";

/// Where a metric of the display picture against the reference stands in a cell's `error`.
std::string error_key(std::string_view metric);

struct TimeErrorPoint {
    const CellResult* cell = nullptr;
    Interval time_ns;  ///< median of wall_ns, at kIntervalLevel
    Interval error;    ///< its ends are known for flip_mean alone
};

/// The competitors that have this error against the reference, in the group's order. `metric`: one of
/// metric_value_keys().
std::vector<TimeErrorPoint> time_error_points(const GroupResult& group, std::string_view metric);

}  // namespace lightsweep
