// What a layout makes of the surfaces of a view: exact shading of it shows the packing's error and no other.
#pragma once

#include "bench/stress/workbench.h"

#include <vector>

namespace lightsweep {

struct StoredSurfaces {
    std::vector<ReferenceSurface> surfaces;  ///< as shading reads them back, to be shaded in double precision
    double normal_deg = 0.0, alpha = 0.0;    ///< how far they are off at most; alpha relative
};

/// `exact`: Drawing::surfaces() of the same view.
StoredSurfaces stored_surfaces(const Drawing& drawing, const std::vector<ReferenceSurface>& exact);

/// Whether the arm's path stores surfaces in less than 32-bit floats.
bool packs(const StressArm& arm);

}  // namespace lightsweep
