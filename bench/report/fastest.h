// Who is fastest from which light count to which: the lower envelope of the arms' times. Pure functions of samples.
#pragma once

#include "bench/report/record.h"

#include <optional>
#include <vector>

namespace lightsweep {

/// `arm` without its light count.
CellParams without_lights(CellParams arm);

/// Whether one may be taken for the other: of one HDR format, guards and sums, and of one layout where both have one.
bool same_kind(const CellParams& a, const CellParams& b);

struct FastestRange {
    CellParams arm;  ///< its light count is of no meaning
    int from_lights = 0, to_lights = 0;
    /// At every light count of the range every other arm is surely slower, or was too slow to sample.
    bool surely = false;
    std::vector<CellParams> rivals;  ///< those that are not surely slower at some count
};

/// Among the competitors of one scene, size, overlap regime, HDR format, skips, guards and sums that have one layout,
/// or none.
struct FastestOverLights {
    CellParams view;  ///< without path, lights and light lists; its layout is that of the arms that have one
    std::vector<FastestRange> ranges;  ///< by rising light count
};

/// For each that has two arms and two light counts or more, in the order met. At each count the smallest median wins;
/// how surely is judged by its paired ratio to each other arm against the group's noise floor (without one: not at
/// all), on the interval of level_for_each() for all n (n - 1) / 2 pairs.
std::vector<FastestOverLights> find_fastest(const std::vector<GroupResult>& groups, std::optional<double> run_floor);

}  // namespace lightsweep
