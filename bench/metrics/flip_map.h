// The error map of FLIP, of two pictures as a display shows them.
#pragma once

#include "bench/metrics/flip.h"

#include <functional>
#include <span>

namespace lightsweep {

/// Turns stored values of one channel into the linear light, in [0, 1], of a display that shows them.
using Show = std::function<void(std::span<float>)>;

/// Per pixel the largest error over all ways to show both pictures, which have one size. A pixel that is not finite in
/// either is black in both for the filters, and NaN in the map. The exposures are left to the caller.
FlipMap flip_map(const Image& reference, const Image& test, std::span<const Show> shows, double pixels_per_degree);

}  // namespace lightsweep
