// Meshes for what the rays meet: quads and triangles placed by hand.
#pragma once

#include "renderer/reference/cast_visibility.h"
#include "renderer/reference/surfaces.h"

namespace lightsweep {

inline Vertex vertex_at(const glm::vec3& position, const glm::vec3& normal = {0, 0, 1}) {
    return {.position = position, .normal = normal, .tangent = {1, 0, 0, 1}, .uv = {}};
}

/// Appends a mesh of triangles, with a material of its own, and one instance of it.
inline void add_mesh(Scene& scene, const std::vector<Vertex>& vertices, const std::vector<uint32_t>& indices,
                     const glm::dmat4& transform = glm::dmat4(1.0), const Material& material = {}) {
    Mesh mesh{.name = "mesh",
              .first_index = static_cast<uint32_t>(scene.indices.size()),
              .index_count = static_cast<uint32_t>(indices.size()),
              .material = static_cast<uint32_t>(scene.materials.size()),
              .bounds = {}};
    const auto base = static_cast<uint32_t>(scene.vertices.size());
    for (const auto& vertex : vertices) mesh.bounds.include(glm::dvec3(vertex.position));
    for (const uint32_t index : indices) scene.indices.push_back(base + index);
    scene.vertices.insert(scene.vertices.end(), vertices.begin(), vertices.end());
    scene.materials.push_back(material);
    scene.instances.push_back({.mesh = static_cast<uint32_t>(scene.meshes.size()), .transform = transform});
    scene.meshes.push_back(mesh);
}

/// From (-1, -1, 0) to (1, 1, 0), facing +z.
inline void add_quad(Scene& scene, const glm::dmat4& transform = glm::dmat4(1.0), const Material& material = {},
                     const glm::vec3& normal = {0, 0, 1}) {
    add_mesh(scene,
             {vertex_at({-1, -1, 0}, normal), vertex_at({1, -1, 0}, normal), vertex_at({1, 1, 0}, normal),
              vertex_at({-1, 1, 0}, normal)},
             {0, 1, 2, 0, 2, 3}, transform, material);
}

/// At (0, 0, 4), looking down -z, 90 degrees high: pixel (x, y) of an n x n picture looks along
/// ((2 x + 1) / n - 1, 1 - (2 y + 1) / n, -1).
inline constexpr Camera kFrontCamera{
    .eye = {0, 0, 4}, .target = {0, 0, 0}, .fov_y_deg = 90.0, .near_distance = 0.1, .far_distance = 100.0};

/// Triangle 0 of instance 0 everywhere, whatever a rasteriser would say.
inline Visibility first_triangle_everywhere(int width, int height) {
    Visibility visible{.width = width, .height = height, .triangles = {}, .texels = {}};
    visible.triangles.assign(static_cast<size_t>(width) * static_cast<size_t>(height), {0, 0});
    return visible;
}

/// The surface of triangle 0 of instance 0 in the middle of the view.
inline ReferenceSurface middle_surface(const Scene& scene, const Camera& camera = kFrontCamera,
                                       const std::vector<SampledTexels>& texels = {}) {
    Visibility visible = first_triangle_everywhere(1, 1);
    visible.texels = texels;
    return reference_surfaces(scene, camera, visible).front();
}

}  // namespace lightsweep
