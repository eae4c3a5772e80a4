// Surfaces of revolution about y, and flat faces: what the generated shapes are put together from.
#pragma once

#include "renderer/scene/geometry.h"

namespace lightsweep {

/// The unit vector (sin, cos) of `turn` whole turns; one whole turn is exactly none, so that seams close.
glm::dvec2 unit_circle(double turn);

/// One point of a profile that runs down the outside: radius and height, with their derivatives.
struct ProfilePoint {
    double radius = 0.0, y = 0.0;
    double d_radius = 0.0, d_y = 0.0;
};
using Profile = std::function<ProfilePoint(double v)>;

/// A straight profile from `from` to `to`, each (radius, y).
Profile line_profile(const glm::dvec2& from, const glm::dvec2& to);

/// A part of an ellipse around `center` (radius, y); the angle, in turns, is 0 at its top and 1/4 at its outside.
Profile arc_profile(const glm::dvec2& center, const glm::dvec2& semi_axes, double from_turn, double to_turn);

/// Turns a profile about y.
void add_lathe(Geometry& geometry, int segments, int rows, const Profile& profile);

/// A flat parallelogram; `right` and `up` are its edges, its front is along cross(right, up).
void add_face(Geometry& geometry, const glm::dvec3& center, const glm::dvec3& right, const glm::dvec3& up,
              const glm::ivec2& segments);

/// Six faces.
void add_box(Geometry& geometry, const glm::dvec3& center, const glm::dvec3& size, int segments);

}  // namespace lightsweep
