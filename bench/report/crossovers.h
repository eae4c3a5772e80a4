// The light counts at which each path and layout meets the forward path. Pure functions of samples.
#pragma once

#include "bench/report/record.h"

#include "bench/stats/crossover.h"

#include <vector>

namespace lightsweep {

/// An arm other than forward against the forward arm of the same HDR format, over the light count.
struct ArmCrossover {
    CellParams a;  ///< its light count is of no meaning
    CellParams b;
    Crossover crossover;
};

/// For each scene, size and overlap regime that has both arms at two light counts or more, in the order met.
std::vector<ArmCrossover> find_crossovers(const std::vector<GroupResult>& groups);

}  // namespace lightsweep
