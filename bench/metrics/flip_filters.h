// The filters of FLIP: what the eye resolves of brightness and colour at a distance, and what it sees as edge or point.
#pragma once

#include "bench/metrics/row_filter.h"

namespace lightsweep {

/// Each is applied along rows, then across them. A sum of two Gaussians is not separable: blue-yellow has a filter for
/// each, and their results are added.
struct FlipFilters {
    RowFilter<float> achromatic, red_green, wide_blue_yellow, narrow_blue_yellow;
    RowFilter<float> gaussian, edge, point;  ///< edge (odd) or point along the feature, gaussian across it
    int radius = 0;                          ///< of the widest
};

/// `pixels_per_degree` at least 1.
FlipFilters flip_filters(double pixels_per_degree);

}  // namespace lightsweep
