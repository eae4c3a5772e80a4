#include "renderer/scene/shapes.h"

#include "renderer/scene/lathe.h"

namespace lightsweep {

Geometry make_shape(const PlaneShape& shape) {
    Geometry geometry;
    add_face(geometry, {}, {shape.size.x, 0.0, 0.0}, {0.0, 0.0, -shape.size.y}, shape.segments);
    return geometry;
}

Geometry make_shape(const QuadShape& shape) {
    Geometry geometry;
    add_face(geometry, {}, {shape.size.x, 0.0, 0.0}, {0.0, shape.size.y, 0.0}, shape.segments);
    return geometry;
}

Geometry make_shape(const BoxShape& shape) {
    Geometry geometry;
    add_box(geometry, {}, shape.size, shape.segments);
    return geometry;
}

Geometry make_shape(const SphereShape& shape) {
    Geometry geometry;
    add_lathe(geometry, shape.segments, shape.rings, arc_profile({}, glm::dvec2(shape.radius), 0.0, 0.5));
    return geometry;
}

Geometry make_shape(const CylinderShape& shape) {
    Geometry geometry;
    const double r = shape.radius;
    const double top = 0.5 * shape.height;
    add_lathe(geometry, shape.segments, 1, line_profile({0.0, top}, {r, top}));
    add_lathe(geometry, shape.segments, 1, line_profile({r, top}, {r, -top}));
    add_lathe(geometry, shape.segments, 1, line_profile({r, -top}, {0.0, -top}));
    return geometry;
}

Geometry make_shape(const ConeShape& shape) {
    Geometry geometry;
    const double top = 0.5 * shape.height;
    add_lathe(geometry, shape.segments, 1, line_profile({0.0, top}, {shape.radius, -top}));
    add_lathe(geometry, shape.segments, 1, line_profile({shape.radius, -top}, {0.0, -top}));
    return geometry;
}

Geometry make_shape(const TorusShape& shape) {
    Geometry geometry;
    add_lathe(geometry, shape.segments, shape.sides,
              arc_profile({shape.radius, 0.0}, glm::dvec2(shape.tube), 0.0, 1.0));
    return geometry;
}

}  // namespace lightsweep
