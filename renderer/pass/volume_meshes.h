// Closed meshes around the places that lights reach: flat faces outside a round shape, so that they cut nothing off.
// Knows no GL.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace lightsweep {

/// Triangles are counter-clockwise seen from outside.
struct VolumeMesh {
    std::vector<glm::vec3> vertices;
    std::vector<uint32_t> indices;
};

/// Around the unit sphere.
VolumeMesh make_enclosing_sphere();

/// Around every cone with a spherical cap, of half angles up to 90 degrees: lib/light_volume.glsl gives it its shape.
/// A vertex (x, y, level) is off the axis by (x, y) times the radius of its level: 0 the apex, 1 the cap's rim, 2 the
/// cap's lid (see cone_profile there).
VolumeMesh make_enclosing_cone();

}  // namespace lightsweep
