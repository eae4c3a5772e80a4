// A few interleaved frames of some arms, to choose one of them: less than a measurement, more than a model.
#pragma once

#include "bench/measure/arm.h"

#include <optional>
#include <vector>

namespace lightsweep {

/// The median wall time of a frame of each cell's arm, ns; nothing for one that the device or the scene refuses. Cells
/// have nothing left to choose. Compiles each.
std::vector<std::optional<double>> try_arms(const std::vector<CellParams>& cells, const Subject& subject,
                                            FrameBuffers& buffers, const DrawShapes& shapes);

}  // namespace lightsweep
