// The column: every length is a multiple of the shaft's radius, after the proportions of a Tuscan order with flutes.
#include "renderer/scene/lathe.h"
#include "renderer/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

constexpr double kPlinthHeight = 0.4, kPlinthWidth = 2.8;
constexpr double kTorusTube = 0.2, kTorusRadius = 1.15;  // the moulding at the foot
constexpr double kNeckRadius = 0.85;                     // the shaft tapers to this
constexpr double kRingTube = 0.07;                       // the ring under the capital
constexpr double kEchinus = 0.32;                        // the capital's quarter round, as wide as high
constexpr double kAbacusHeight = 0.35, kAbacusWidth = 2.5;
constexpr double kFluteDepth = 0.07;  // of the radius
constexpr double kFluteFade = 0.06;   // part of the shaft over which flutes run out at each end

struct Slope {
    double value, derivative;
};

// 0 at both ends of the shaft, 1 between.
Slope flute_strength(double v) {
    const double x = std::min(v, 1.0 - v) / kFluteFade;
    if (x >= 1.0) return {1.0, 0.0};
    const double sign = v < 0.5 ? 1.0 : -1.0;
    return {x * x * (3.0 - 2.0 * x), sign * 6.0 * x * (1.0 - x) / kFluteFade};
}

// radius(u, v) = taper(v) * (1 - depth * strength(v) * (1 - cos(flutes * angle)) / 2), differentiated by hand so that
// the normals are exact.
void add_shaft(Geometry& geometry, const ColumnShape& shape, double top, double bottom) {
    add_patch(geometry, shape.flutes * shape.tessellation, shape.rows, [&](double u, double v) {
        const double neck = kNeckRadius * shape.radius;
        const Slope taper{neck + (shape.radius - neck) * v, shape.radius - neck};
        const Slope strength = flute_strength(v);
        const double phase = 2.0 * std::numbers::pi * shape.flutes * (u < 1.0 ? u : 0.0);
        const double wave = kFluteDepth * 0.5 * (1.0 - std::cos(phase));
        const double factor = 1.0 - strength.value * wave;
        const double radius = taper.value * factor;
        const double by_angle = -taper.value * strength.value * kFluteDepth * 0.5 * std::sin(phase) * shape.flutes;
        const double by_v = taper.derivative * factor - taper.value * strength.derivative * wave;

        const glm::dvec2 direction = unit_circle(u);
        const glm::dvec3 outward(direction.x, 0.0, direction.y);
        const glm::dvec3 around(direction.y, 0.0, -direction.x);
        const glm::dvec3 along_u = glm::normalize(outward * by_angle + around * radius);
        const glm::dvec3 along_v = outward * by_v + glm::dvec3(0.0, bottom - top, 0.0);
        const double y = v < 1.0 ? top + (bottom - top) * v : bottom;
        return make_vertex(outward * radius + glm::dvec3(0.0, y, 0.0), glm::normalize(glm::cross(along_u, -along_v)),
                           along_u, {u, v});
    });
}

}  // namespace

Geometry make_shape(const ColumnShape& shape) {
    Geometry geometry;
    const double r = shape.radius;
    const int around = shape.flutes * shape.tessellation;
    const int rows = shape.tessellation + (shape.tessellation + 1) / 2;
    const double plinth = kPlinthHeight * r;
    const double foot = plinth + 2.0 * kTorusTube * r;
    const double abacus = shape.height - kAbacusHeight * r;
    const double ring = abacus - kEchinus * r;
    const double neck = ring - 2.0 * kRingTube * r;
    const double neck_radius = kNeckRadius * r;

    add_box(geometry, {0.0, 0.5 * (shape.height + abacus), 0.0},
            {kAbacusWidth * r, shape.height - abacus, kAbacusWidth * r}, 1);
    add_lathe(geometry, around, rows, arc_profile({neck_radius, abacus}, glm::dvec2(kEchinus * r), 0.25, 0.5));
    add_lathe(geometry, around, rows,
              arc_profile({neck_radius, ring - kRingTube * r}, glm::dvec2(kRingTube * r), 0.0, 0.5));
    add_shaft(geometry, shape, neck, foot);
    add_lathe(geometry, around, 1, line_profile({r, foot}, {kTorusRadius * r, foot}));
    add_lathe(geometry, around, rows,
              arc_profile({kTorusRadius * r, plinth + kTorusTube * r}, glm::dvec2(kTorusTube * r), 0.0, 0.5));
    add_box(geometry, {0.0, 0.5 * plinth, 0.0}, {kPlinthWidth * r, plinth, kPlinthWidth * r}, 1);
    return geometry;
}

}  // namespace lightsweep
