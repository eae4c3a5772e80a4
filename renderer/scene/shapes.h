// Generated meshes with exact normals, tangents and texture coordinates. Front faces are counter-clockwise; seen from
// outside, u runs to the right and v down. Lengths are in scene units; counts are the caller's duty to keep in range.
#pragma once

#include "renderer/scene/geometry.h"

namespace lightsweep {

/// In the plane y = 0, facing up, centred.
struct PlaneShape {
    glm::dvec2 size{1.0};  ///< along x and z
    glm::ivec2 segments{1};
};
/// In the plane z = 0, facing +z, centred.
struct QuadShape {
    glm::dvec2 size{1.0};  ///< along x and y
    glm::ivec2 segments{1};
};
/// Centred.
struct BoxShape {
    glm::dvec3 size{1.0};
    int segments = 1;  ///< per edge
};
/// Centred, poles on y.
struct SphereShape {
    double radius = 0.5;
    int segments = 32;  ///< around
    int rings = 16;     ///< from pole to pole
};
/// Centred, along y, closed.
struct CylinderShape {
    double radius = 0.5;
    double height = 1.0;
    int segments = 32;
};
/// Centred, its apex up, closed.
struct ConeShape {
    double radius = 0.5;
    double height = 1.0;
    int segments = 32;
};
/// Centred, around y.
struct TorusShape {
    double radius = 0.5;  ///< of the ring's centre line
    double tube = 0.2;
    int segments = 32;  ///< around y
    int sides = 16;     ///< around the tube
};
/// Stands on y = 0: plinth, base moulding, tapered and fluted shaft, capital, abacus. Between plinth and abacus, which
/// are boxes, the turned part is open where they cover it.
struct ColumnShape {
    double radius = 0.5;  ///< of the shaft at its foot; the plinth is 2.8 times as wide
    double height = 5.0;  ///< all of it, at least 4 radii
    int flutes = 20;
    int tessellation = 4;  ///< segments per flute; mouldings have 1.5 times as many rows
    int rows = 16;         ///< of the shaft
};
/// A wall on y = 0 with a half-round opening cut from below; closed.
struct ArchShape {
    double span = 3.0;    ///< the opening's diameter, less than the width
    double width = 4.0;   ///< along x
    double height = 2.5;  ///< more than span / 2
    double depth = 0.6;   ///< along z
    int segments = 24;    ///< of the curve
};

Geometry make_shape(const PlaneShape& shape);
Geometry make_shape(const QuadShape& shape);
Geometry make_shape(const BoxShape& shape);
Geometry make_shape(const SphereShape& shape);
Geometry make_shape(const CylinderShape& shape);
Geometry make_shape(const ConeShape& shape);
Geometry make_shape(const TorusShape& shape);
Geometry make_shape(const ColumnShape& shape);
Geometry make_shape(const ArchShape& shape);

}  // namespace lightsweep
