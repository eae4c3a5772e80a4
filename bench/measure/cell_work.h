// What one frame of an arm did, as numbers for the report.
#pragma once

#include "bench/measure/arm.h"
#include "bench/report/record.h"

#include <cstdint>
#include <optional>

namespace lightsweep {

/// Of the arm's last frame, but for what count_lights finds out. `drawn`: the arm's cell.
CellWork cell_work(const Arm& arm, const Subject& subject, const CellParams& drawn);

/// Draws another frame to count its light evaluations. `light_hits`: those that any path must do, where they are known.
void count_lights(Arm& arm, std::optional<int64_t> light_hits, CellWork& work);

/// The work of a frame that asks for the same as `settled`'s, of which `first` is known from a first frame alone.
CellWork like_settled(const CellWork& settled, const CellWork& first);

}  // namespace lightsweep
