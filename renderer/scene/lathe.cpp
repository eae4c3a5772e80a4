#include "renderer/scene/lathe.h"

#include <cmath>
#include <numbers>

namespace lightsweep {

glm::dvec2 unit_circle(double turn) {
    if (turn >= 1.0) turn -= 1.0;
    const double angle = 2.0 * std::numbers::pi * turn;
    return {std::sin(angle), std::cos(angle)};
}

Profile line_profile(const glm::dvec2& from, const glm::dvec2& to) {
    return [=](double v) {
        const glm::dvec2 p = v < 1.0 ? from + (to - from) * v : to;
        return ProfilePoint{p.x, p.y, to.x - from.x, to.y - from.y};
    };
}

Profile arc_profile(const glm::dvec2& center, const glm::dvec2& semi_axes, double from_turn, double to_turn) {
    return [=](double v) {
        const double turns = to_turn - from_turn;
        const glm::dvec2 direction = unit_circle(from_turn + turns * v);
        const glm::dvec2 p = center + semi_axes * direction;
        return ProfilePoint{p.x, p.y, semi_axes.x * direction.y * turns, -semi_axes.y * direction.x * turns};
    };
}

void add_lathe(Geometry& geometry, int segments, int rows, const Profile& profile) {
    add_patch(geometry, segments, rows, [&](double u, double v) {
        const ProfilePoint p = profile(v);
        const glm::dvec2 direction = unit_circle(u);
        const glm::dvec3 outward(direction.x, 0.0, direction.y);
        const glm::dvec3 tangent(direction.y, 0.0, -direction.x);
        const glm::dvec3 normal = glm::normalize(outward * -p.d_y + glm::dvec3(0.0, p.d_radius, 0.0));
        return make_vertex(outward * p.radius + glm::dvec3(0.0, p.y, 0.0), normal, tangent, {u, v});
    });
}

void add_face(Geometry& geometry, const glm::dvec3& center, const glm::dvec3& right, const glm::dvec3& up,
              const glm::ivec2& segments) {
    const glm::dvec3 normal = glm::normalize(glm::cross(right, up));
    const glm::dvec3 tangent = glm::normalize(right);
    add_patch(geometry, segments.x, segments.y, [&](double u, double v) {
        return make_vertex(center + right * (u - 0.5) + up * (0.5 - v), normal, tangent, {u, v});
    });
}

void add_box(Geometry& geometry, const glm::dvec3& center, const glm::dvec3& size, int segments) {
    const glm::dvec3 x(size.x, 0.0, 0.0);
    const glm::dvec3 y(0.0, size.y, 0.0);
    const glm::dvec3 z(0.0, 0.0, size.z);
    const glm::ivec2 cells(segments);
    add_face(geometry, center + 0.5 * z, x, y, cells);
    add_face(geometry, center - 0.5 * z, -x, y, cells);
    add_face(geometry, center + 0.5 * x, -z, y, cells);
    add_face(geometry, center - 0.5 * x, z, y, cells);
    add_face(geometry, center + 0.5 * y, x, -z, cells);
    add_face(geometry, center - 0.5 * y, x, z, cells);
}

}  // namespace lightsweep
