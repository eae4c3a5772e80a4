// What a light reaches, as culling sees it: spheres and cones in view space, and their rectangles on the screen.
#pragma once

#include "renderer/frame/frame.h"

#include <vector>

namespace lightsweep {

struct Sphere {
    glm::dvec3 center;
    double radius;
};

/// The smallest sphere around a cone that ends in a spherical cap: all points within `range` of `apex` whose direction
/// from there is within the half angle of `axis` (unit). Around all of the range when the half angle is 90 degrees or
/// more.
Sphere sphere_around_cone(const glm::dvec3& apex, const glm::dvec3& axis, double range, double cos_half_angle);

/// The bounds of the frame's point and spot lights, in their order (the first is light `data.directional_count`). A
/// spot's sphere is the smallest around its cone's cap. All are grown by `position_error` times the distance from the
/// eye, and by a little for rounding: `position_error` is how far a surface's position, as shading reads it, may be off
/// its place in the picture, relative to its distance (layouts that store positions in few bits); up to 1/8.
void light_bounds(const Frame& frame, double position_error, std::vector<shared::LightBounds>& bounds);

/// Pixels [x0, x1) x [y0, y1), lower left origin.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    bool operator==(const PixelRect&) const = default;
};

/// The smallest rectangle that holds every pixel centre whose ray meets the light's sphere in front of the eye (Mara
/// and McGuire 2013, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere"). All of the picture when the
/// eye is inside; empty, all zero, when the sphere is behind the eye, beside the picture or between pixel centres.
PixelRect screen_rect(const shared::LightBounds& light, const FrameSetup& setup);

}  // namespace lightsweep
