// A triangle of an instance, placed relative to the camera's eye in double precision.
#pragma once

#include "renderer/reference/visibility.h"
#include "renderer/scene/scene.h"

#include <array>

namespace lightsweep {

/// An instance's transform with the eye as the origin.
struct PlacedInstance {
    glm::dmat3 linear;       ///< mesh to world directions
    glm::dmat3 for_normals;  ///< its inverse transpose times a positive number; exists for singular ones too
    glm::dvec3 translation;
    bool mirrored;  ///< it turns triangles inside out
};

PlacedInstance place(const Instance& instance, const glm::dvec3& eye);

/// The three vertices of a mesh's triangle. CHECKs that it exists.
std::array<const Vertex*, 3> corners(const Scene& scene, const Mesh& mesh, uint32_t triangle);

/// A corner, and the edges from it to the other two. The edges come from differences in mesh space, which are exact, so
/// that they keep all their digits however far away the triangle is.
struct PlacedTriangle {
    glm::dvec3 corner, edge1, edge2;

    PlacedTriangle(const std::array<const Vertex*, 3>& vertices, const PlacedInstance& placement);
    glm::dvec3 at(double weight1, double weight2) const { return corner + edge1 * weight1 + edge2 * weight2; }
};

}  // namespace lightsweep
