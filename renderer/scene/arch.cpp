// The arch: a wall whose front is ruled from its outline to the half circle, seen from the circle's centre, so that the
// curve, the front and the outline share their vertices.
#include "renderer/scene/lathe.h"
#include "renderer/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

// From the left foot over the top to the right foot; both points lie on one ray from the circle's centre.
struct Rib {
    glm::dvec2 curve, outline;
    glm::dvec2 inward;  // from the curve to its centre
};

// A straight edge of the outline between two ribs' angles, in turns from the left foot (0) to the right one (1/2).
struct Side {
    double from_turn, to_turn;
    glm::dvec2 normal;    // out of the wall
    double distance = 0;  // of the edge from the centre
    int segments = 1;
};

Rib rib_at(const ArchShape& shape, const Side& side, double t) {
    const double turn = t < 1.0 ? side.from_turn + (side.to_turn - side.from_turn) * t : side.to_turn;
    const double angle = 2.0 * std::numbers::pi * turn;
    // The feet are on y = 0 exactly.
    const glm::dvec2 direction(-std::cos(angle), turn == 0.0 || turn == 0.5 ? 0.0 : std::sin(angle));
    return {0.5 * shape.span * direction, direction * (side.distance / glm::dot(direction, side.normal)), -direction};
}

// Front or back: between the outline (v = 0) and the curve (v = 1).
void add_front(Geometry& geometry, const ArchShape& shape, const Side& side, bool back) {
    const double z = (back ? -0.5 : 0.5) * shape.depth;
    const glm::dvec3 normal(0.0, 0.0, back ? -1.0 : 1.0);
    const glm::dvec3 tangent(back ? -1.0 : 1.0, 0.0, 0.0);
    add_patch(geometry, side.segments, 1, [&](double u, double v) {
        const Rib rib = rib_at(shape, side, back ? 1.0 - u : u);
        const glm::dvec2 p = v == 0.0 ? rib.outline : rib.curve;
        const double across = 0.5 + tangent.x * p.x / shape.width;
        return make_vertex({p, z}, normal, tangent, {across, 1.0 - p.y / shape.width});
    });
}

}  // namespace

Geometry make_shape(const ArchShape& shape) {
    Geometry geometry;
    const double half = 0.5 * shape.width;
    const double corner = std::atan2(shape.height, half) / (2.0 * std::numbers::pi);
    const int flank = std::max(1, static_cast<int>(std::lround(shape.segments * corner * 2.0)));
    const int top = std::max(1, shape.segments - 2 * flank);
    const Side sides[] = {{0.0, corner, {-1.0, 0.0}, half, flank},
                          {corner, 0.5 - corner, {0.0, 1.0}, shape.height, top},
                          {0.5 - corner, 0.5, {1.0, 0.0}, half, flank}};
    const double z = 0.5 * shape.depth;
    for (const Side& side : sides) {
        add_front(geometry, shape, side, false);
        add_front(geometry, shape, side, true);
        const glm::dvec2 along(side.normal.y, -side.normal.x);
        add_patch(geometry, side.segments, 1, [&](double u, double v) {  // the outline, seen from outside
            const glm::dvec2 p = rib_at(shape, side, u).outline;
            return make_vertex({p, v == 0.0 ? -z : z}, {side.normal, 0.0}, {along, 0.0},
                               {0.5 + glm::dot(p, along) / shape.width, v * shape.depth / shape.width});
        });
        add_patch(geometry, side.segments, 1, [&](double u, double v) {  // the vault, seen from below
            const Rib rib = rib_at(shape, side, u);
            const glm::dvec3 tangent(-rib.inward.y, rib.inward.x, 0.0);
            const double length = 0.5 * std::numbers::pi * shape.span;
            const double turn = side.from_turn + (side.to_turn - side.from_turn) * u;
            return make_vertex({rib.curve, v == 0.0 ? z : -z}, {rib.inward, 0.0}, tangent,
                               {2.0 * turn * length / shape.width, v * shape.depth / shape.width});
        });
    }
    const double foot = half - 0.5 * shape.span;
    for (const double side : {-1.0, 1.0}) {
        add_face(geometry, {side * (half - 0.5 * foot), 0.0, 0.0}, {foot, 0.0, 0.0}, {0.0, 0.0, shape.depth}, {1, 1});
    }
    return geometry;
}

}  // namespace lightsweep
