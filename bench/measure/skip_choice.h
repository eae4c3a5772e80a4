// What skip=auto comes to: everything, but for skips that cost this cell more than they save. Some of that the scene
// says, some only a trial: what is decided how stands in one table here.
#pragma once

#include "bench/measure/arm.h"
#include "bench/report/record.h"
#include "bench/stats/quantile.h"
#include "renderer/frame/needs.h"

#include <functional>
#include <optional>

namespace lightsweep {

/// What decides without a trial.
struct SkipFacts {
    uint64_t instances = 0;     ///< of the scene
    size_t local_lights = 0;    ///< points and spots of the cell
    bool lists_lights = false;  ///< the cell's path does
    double listed_share = 0.0;  ///< of the local lights, that the list of a cell of the grid holds on average
};

/// A frame with a skip against one without, all else equal.
struct SkipTrial {
    bool same_work = false;  ///< there is nothing to choose, and `ratio` is of no meaning
    Interval ratio;          ///< time with it over time without it
};

/// Nothing when it cannot be tried, or no more.
using TrySkip = std::function<std::optional<SkipTrial>(SkipSet with, SkipSet without)>;

/// Begins with all and turns off one after another what costs more than it saves: the next is tried with what is left.
SkipChoice choose_skips(const SkipFacts& facts, const TrySkip& try_skip);

/// A skip is turned off when frames with it take longer by more than this share, and surely longer.
inline constexpr double kSkipMustSave = 0.01;

/// The same by frames of the cell's arms, drawn for it: a few seconds. Where one frame takes long nothing is tried:
/// what a skip costs does not grow with the frame as what it saves does. `cell.skip` does not matter; the rest has
/// nothing left to choose. Throws what Arm throws for the cell with all skips.
SkipChoice choose_skips(const CellParams& cell, const Subject& subject, FrameBuffers& buffers,
                        const DrawShapes& shapes);

}  // namespace lightsweep
