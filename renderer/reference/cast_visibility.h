// Visibility found on the CPU in double precision, for where there is no GL: tests and benchmarks. A device decides
// differently for pixel centres within its rounding of an edge. Samples no textures, and so cuts nothing by alpha.
#pragma once

#include "renderer/reference/visibility.h"
#include "renderer/scene/scene.h"

namespace lightsweep {

/// The nearest triangle between the near and the far plane under every pixel centre, on all cores. Triangles that face
/// away are left out unless their material is double-sided; of two at one distance the first in scene order is seen.
Visibility cast_visibility(const Scene& scene, const Camera& camera, int width, int height);

}  // namespace lightsweep
