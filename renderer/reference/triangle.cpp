#include "renderer/reference/triangle.h"

#include "renderer/base/check.h"

namespace lightsweep {

PlacedInstance place(const Instance& instance, const glm::dvec3& eye) {
    const glm::dmat3 m(instance.transform);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const bool mirrored = glm::dot(m[0], cofactors[0]) < 0.0;
    return {.linear = m,
            .for_normals = mirrored ? -cofactors : cofactors,
            .translation = glm::dvec3(instance.transform[3]) - eye,
            .mirrored = mirrored};
}

std::array<const Vertex*, 3> corners(const Scene& scene, const Mesh& mesh, uint32_t triangle) {
    const uint64_t first = mesh.first_index + uint64_t{3} * triangle;
    CHECK_THAT(uint64_t{3} * triangle + 3 <= mesh.index_count && first + 3 <= scene.indices.size(),
               "triangle {} of a mesh of {} indices", triangle, mesh.index_count);
    const uint32_t* index = &scene.indices[first];
    return {&scene.vertices[index[0]], &scene.vertices[index[1]], &scene.vertices[index[2]]};
}

PlacedTriangle::PlacedTriangle(const std::array<const Vertex*, 3>& vertices, const PlacedInstance& placement) {
    const glm::dvec3 a = vertices[0]->position, b = vertices[1]->position, c = vertices[2]->position;
    corner = placement.linear * a + placement.translation;
    edge1 = placement.linear * (b - a);
    edge2 = placement.linear * (c - a);
}

}  // namespace lightsweep
