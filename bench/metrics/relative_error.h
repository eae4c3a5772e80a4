// The relative error of a pixel, of which `max_rel` is the largest and `percentiles` are the distribution.
#pragma once

#include "bench/metrics/reduce.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lightsweep {

/// The largest channel's difference by the reference's largest channel, which counts as 1e-4 at least, so that black
/// pixels do not decide. `r`, `v`: RGB, linear. Nothing where either is not finite.
inline std::optional<double> relative_error(const float* r, const float* v) {
    constexpr double kDarkest = 1e-4;
    if (!all_finite({r, 3}) || !all_finite({v, 3})) return {};
    double difference = 0, magnitude = kDarkest;
    for (int c = 0; c < 3; ++c) {
        difference = std::max(difference, std::abs(double{v[c]} - double{r[c]}));
        magnitude = std::max(magnitude, std::abs(double{r[c]}));
    }
    return difference / magnitude;
}

}  // namespace lightsweep
