// What every shading path must do at least: one evaluation for each covered pixel and light that reaches it. Pure
// functions; know no GL.
#pragma once

#include "renderer/reference/surfaces.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <span>

namespace lightsweep {

/// Over the covered surfaces, the sum of the lights that reach their positions: within the radius and the cone,
/// whichever way the surface faces; directional lights reach everything. `eye`: what the surfaces' positions are
/// relative to.
int64_t count_light_hits(std::span<const ReferenceSurface> surfaces, std::span<const Light> lights,
                         const glm::dvec3& eye);

}  // namespace lightsweep
