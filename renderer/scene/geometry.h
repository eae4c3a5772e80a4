// Triangle lists on their way into a scene: parametric patches, and the normals and tangents that a file left out.
#pragma once

#include "renderer/scene/scene.h"

#include <functional>

namespace lightsweep {

struct Geometry {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;  ///< three per triangle
};

/// A vertex from double precision; the bitangent is cross(normal, tangent). Unit vectors are the caller's duty.
Vertex make_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                   const glm::dvec2& uv);

/// Adds `columns` x `rows` cells of surface(u, v), u and v in [0, 1]. Seen from the front, u runs to the right and v
/// down, as in an image; so cross(dP/du, -dP/dv) is the normal. Triangles that collapse to a line are left out.
void add_patch(Geometry& geometry, int columns, int rows, const std::function<Vertex(double u, double v)>& surface);

/// Gives every triangle three vertices of its own with the triangle's normal, as glTF 2.0 asks where normals are
/// missing.
void make_flat_normals(Geometry& geometry);

/// Fills in tangents from texture coordinates as MikkTSpace does: corners that share position, normal, coordinates and
/// handedness are averaged, weighted by their angle. A vertex that is used with both handednesses is split. The
/// bitangent points up in the image (against v). Where coordinates say nothing, any tangent across the normal is taken.
/// Source: M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008.
void make_tangents(Geometry& geometry);

/// Appends the geometry to the scene's arrays. The mesh is returned, its material still to be set, not appended: a
/// shape may stand in the scene with several materials. Throws InputError (naming `place`) past 2^32 - 1 vertices or
/// indices.
Mesh append_geometry(Scene& scene, const Geometry& geometry, std::string name, const std::string& place);

/// Of the eight corners of `bounds` after the transform.
Bounds transformed(const Bounds& bounds, const glm::dmat4& transform);

}  // namespace lightsweep
