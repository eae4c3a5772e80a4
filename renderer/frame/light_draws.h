// Which instances each point or spot light may reach: the culling of objects by light that a path with a pass for each
// light needs. Built on the CPU; knows no GL.
#pragma once

#include "renderer/frame/light_bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

struct LightDraw {
    uint32_t light;  ///< index into Frame::lights
    DrawCall draw;   ///< its `first_visible` counts in LightDraws::instances
};

struct LightDraws {
    std::vector<LightDraw> draws;  ///< by batch, then by light
    std::vector<uint32_t> instances;
};

/// Those of `drawn` whose bounding sphere touches a light's. `lights`: light_bounds of the frame.
LightDraws make_light_draws(const GpuScene& scene, const Frame& frame, const DrawList& drawn,
                            std::span<const shared::LightBounds> lights);

}  // namespace lightsweep
