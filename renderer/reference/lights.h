// Lights as the reference sees them: relative to the eye, in double precision, with what does not vary over a picture
// worked out once; which of them reach a part of it; and what arrives of one at each lane.
#pragma once

#include "renderer/reference/lanes.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

struct PlacedLight {
    LightKind kind;
    glm::dvec3 position;   ///< relative to the eye
    glm::dvec3 direction;  ///< the way it travels
    glm::dvec3 color;
    double radius2;     ///< the radius squared
    double cos_outer;   ///< spot: the cosine at which it ends
    double cone_scale;  ///< spot: one over the difference to the cosine from which on it is full
};

/// In the same order, without those that light nothing anywhere.
std::vector<PlacedLight> place_lights(std::span<const Light> lights, const glm::dvec3& eye);

/// Those of `candidates` (indices into `lights`) that may reach a point of `box`, in the same order. A light that is
/// left out reaches none of them: see light_lanes for why rounding cannot matter.
void lights_reaching(std::span<const PlacedLight> lights, std::span<const uint32_t> candidates, const Bounds& box,
                     std::vector<uint32_t>& reaching);

/// What arrives of `light` at each of the surfaces.
void light_lanes(const PlacedLight& light, const SurfaceLanes& surfaces, IncidentLanes& incident);

}  // namespace lightsweep
