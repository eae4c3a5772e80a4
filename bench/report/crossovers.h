// The light counts at which two arms take the same time. Pure functions of samples.
#pragma once

#include "bench/report/fastest.h"

#include "bench/stats/crossover.h"

#include <vector>

namespace lightsweep {

/// Two competitors of one scene, size and overlap regime, of the same_kind(), over the light count.
struct ArmCrossover {
    CellParams a;  ///< its light count is of no meaning
    CellParams b;
    bool on_envelope = false;  ///< one is the fastest up to some light count, and the other from there on
    Crossover crossover;
};

/// Of the pairs that have two light counts or more: every arm against the forward arm (b), then those of the others
/// that change places or are neighbours in `fastest`; for each scene, size and regime in the order met.
std::vector<ArmCrossover> find_crossovers(const std::vector<GroupResult>& groups,
                                          const std::vector<FastestOverLights>& fastest);

}  // namespace lightsweep
