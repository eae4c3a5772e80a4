// A few interleaved frames of some arms, to choose one of them: less than a measurement, more than a model.
#pragma once

#include "bench/measure/arm.h"
#include "bench/stats/quantile.h"

#include <optional>
#include <vector>

namespace lightsweep {

/// Frames after the first until an arm's are all alike: what one frame hides is known from the last one's depth, and
/// that frame had to be drawn with all it may show.
inline constexpr int kFramesToSettle = 2;

/// The median wall time of a frame of each cell's arm, ns; nothing for one that the device or the scene refuses. Cells
/// have nothing left to choose. Compiles each.
std::vector<std::optional<double>> try_arms(const std::vector<CellParams>& cells, const Subject& subject,
                                            FrameBuffers& buffers, const DrawShapes& shapes);

/// Time of a frame of `a` over one of `b`, from paired frames, with its interval of level 0.8. Both are settled. Draws
/// on, to some end, while the interval holds `edge`.
Interval try_pair(Arm& a, Arm& b, double edge);

}  // namespace lightsweep
