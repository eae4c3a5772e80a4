#include "renderer/pass/volume_meshes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lightsweep {
namespace {

constexpr int kSubdivisions = 1;     // of the icosahedron: 80 faces
constexpr uint32_t kConeSides = 10;  // 40 faces; the prism around a circle is 1.034 times as large

}  // namespace

VolumeMesh make_enclosing_sphere() {
    const float t = (1.0F + std::sqrt(5.0F)) / 2.0F;
    VolumeMesh mesh{
        {{-1, t, 0},
         {1, t, 0},
         {-1, -t, 0},
         {1, -t, 0},
         {0, -1, t},
         {0, 1, t},
         {0, -1, -t},
         {0, 1, -t},
         {t, 0, -1},
         {t, 0, 1},
         {-t, 0, -1},
         {-t, 0, 1}},
        {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
         3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1}};
    for (auto& v : mesh.vertices) v = glm::normalize(v);
    for (int s = 0; s < kSubdivisions; ++s) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> midpoints;
        const auto midpoint = [&](uint32_t a, uint32_t b) {
            const auto [found, is_new] =
                midpoints.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(glm::normalize(mesh.vertices[a] + mesh.vertices[b]));
            return found->second;
        };
        std::vector<uint32_t> finer;
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            const uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
            finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
        }
        mesh.indices = std::move(finer);
    }
    float nearest = 1.0F;  // distance of the nearest face's plane from the centre
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.vertices[mesh.indices[i]], b = mesh.vertices[mesh.indices[i + 1]],
                        c = mesh.vertices[mesh.indices[i + 2]];
        nearest = std::min(nearest, glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
    }
    for (auto& v : mesh.vertices) v /= nearest;
    return mesh;
}

VolumeMesh make_enclosing_cone() {
    VolumeMesh mesh;
    // A regular polygon touches the unit circle inside it when its corners are 1 / cos(pi / n) from the centre.
    const double corner = 1.0 / std::cos(glm::pi<double>() / kConeSides);
    mesh.vertices.emplace_back(0.0F, 0.0F, 0.0F);
    for (const float level : {1.0F, 2.0F}) {
        for (uint32_t i = 0; i < kConeSides; ++i) {
            const double angle = 2.0 * glm::pi<double>() * i / kConeSides;
            mesh.vertices.emplace_back(corner * std::cos(angle), corner * std::sin(angle), level);
        }
    }
    mesh.vertices.emplace_back(0.0F, 0.0F, 2.0F);
    const uint32_t apex = 0, rim = 1, lid = rim + kConeSides, top = lid + kConeSides;
    for (uint32_t i = 0; i < kConeSides; ++i) {
        const uint32_t next = (i + 1) % kConeSides;
        mesh.indices.insert(mesh.indices.end(), {apex, rim + next, rim + i});
        mesh.indices.insert(mesh.indices.end(), {rim + i, rim + next, lid + next, rim + i, lid + next, lid + i});
        mesh.indices.insert(mesh.indices.end(), {lid + i, lid + next, top});
    }
    return mesh;
}

}  // namespace lightsweep
