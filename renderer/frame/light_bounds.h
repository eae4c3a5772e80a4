// What a light reaches, as culling sees it: spheres and cones in view space, and their rectangles on the screen.
#pragma once

#include "renderer/frame/frame.h"

#include <vector>

namespace lightsweep {

/// The bounds of the frame's point and spot lights, in their order (the first is light `data.directional_count`). A
/// spot's sphere is the smallest around its cone's cap. Radii are grown by `position_error` times the distance from the
/// eye, and by a little for rounding: `position_error` is how far a surface's position, as shading reads it, may be off
/// its place in the picture, relative to its distance (layouts that store positions in few bits).
void light_bounds(const Frame& frame, double position_error, std::vector<shared::LightBounds>& bounds);

/// Pixels [x0, x1) x [y0, y1), lower left origin.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    bool operator==(const PixelRect&) const = default;
};

/// The smallest rectangle that holds every pixel centre whose ray meets the light's sphere in front of the eye (Mara and
/// McGuire 2013, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere"), rounded outwards. All of the
/// picture when the eye is inside; empty when the sphere is behind the eye or beside the picture.
PixelRect screen_rect(const shared::LightBounds& light, const FrameSetup& setup);

}  // namespace lightsweep
