// The cost model of this machine: measured once on shipped scenes, kept on disk beside the references.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/cost_model.h"

#include <functional>
#include <optional>

namespace lightsweep {

/// The features of a subject's frame. Builds it and its light lists on the CPU, and draws its depth to count fragments.
CostFeatures cost_features(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes);

/// Measures every path on shipped scenes at a few sizes and light counts. A few minutes on a software renderer, seconds
/// on a GPU. `progress` is told the share that is done.
CostModel calibrate_costs(const Environment& environment, ListBuilder light_lists,
                          const std::function<void(double)>& progress);

/// The model kept for this environment; nothing when there is none yet.
std::optional<CostModel> find_cost_model(const Environment& environment);
/// Keeps it; a folder that cannot be written is no error.
void keep_cost_model(const CostModel& model);

}  // namespace lightsweep
