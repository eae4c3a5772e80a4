// What must hold for the meshes of light volumes: closed, turned outwards, outside the shapes that they stand for.
#include "renderer/pass/volume_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace lightsweep {
namespace {

// Each edge once in each direction: no hole, and all faces turned the same way.
void expect_closed(const VolumeMesh& mesh) {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
            EXPECT_LT(a, mesh.vertices.size());
            EXPECT_TRUE(edges.emplace(a, b).second) << "edge " << a << " " << b << " twice";
        }
    }
    for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a})) << "edge " << a << " " << b << " is open";
}

// How far the nearest face's plane is outside the unit sphere; negative: inside.
double clearance(const VolumeMesh& mesh) {
    double nearest = 1e9;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.vertices[mesh.indices[i]], b = mesh.vertices[mesh.indices[i + 1]],
                         c = mesh.vertices[mesh.indices[i + 2]];
        nearest = std::min(nearest, glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
    }
    return nearest - 1.0;
}

TEST(VolumeMeshes, TheSphereTouchesTheUnitSphereFromOutside) {
    const VolumeMesh sphere = make_enclosing_sphere();
    expect_closed(sphere);
    EXPECT_NEAR(clearance(sphere), 0.0, 1e-6);
    for (const auto& v : sphere.vertices) EXPECT_LT(glm::length(v), 1.1F) << "and is hardly larger";
}

TEST(VolumeMeshes, TheConeIsClosedAndAroundItsCircles) {
    VolumeMesh cone = make_enclosing_cone();
    expect_closed(cone);
    size_t corners = 0;
    for (const auto& v : cone.vertices) corners += v.z == 1.0F ? 1 : 0;
    ASSERT_GE(corners, 3U);
    for (const auto& v : cone.vertices) {
        const float off_axis = std::hypot(v.x, v.y);
        if (off_axis == 0.0F) continue;
        // A polygon of n corners at the distance r holds the circle of radius r cos(pi / n).
        EXPECT_NEAR(static_cast<double>(off_axis) * std::cos(std::acos(-1.0) / static_cast<double>(corners)), 1.0,
                    1e-6);
    }
    // Its shape at 60 degrees, unlike in the shader by tangents: apex, rim, lid.
    const double a = std::acos(-1.0) / 3.0;
    double volume = 0.0;
    for (auto& v : cone.vertices) {
        const double along = v.z == 0.0F ? 0.0 : v.z == 1.0F ? std::cos(a) : 1.0;
        const double off = v.z == 0.0F ? 0.0 : v.z == 1.0F ? std::sin(a) : std::tan(a / 2.0);
        v = glm::vec3(v.x * off, v.y * off, along);
    }
    for (size_t i = 0; i < cone.indices.size(); i += 3) {
        const glm::dvec3 p = cone.vertices[cone.indices[i]], q = cone.vertices[cone.indices[i + 1]],
                         r = cone.vertices[cone.indices[i + 2]];
        const glm::dvec3 normal = glm::cross(q - p, r - p);
        volume += glm::dot(p, glm::cross(q, r)) / 6.0;
        if (glm::length(normal) < 1e-9) continue;
        // No point of the cone with its cap is beyond any face.
        for (int i_angle = 0; i_angle <= 20; ++i_angle) {
            for (int turn = 0; turn < 60; ++turn) {
                const double angle = a * i_angle / 20.0, round = 2.0 * std::acos(-1.0) * turn / 60.0;
                const glm::dvec3 point(std::sin(angle) * std::cos(round), std::sin(angle) * std::sin(round),
                                       std::cos(angle));
                EXPECT_LE(glm::dot(glm::normalize(normal), point - p), 1e-6);
            }
        }
    }
    // Outwards, and tight: a cone of 60 degrees with its cap has the volume pi / 3.
    EXPECT_GT(volume, std::acos(-1.0) / 3.0);
    EXPECT_LT(volume, 1.25 * std::acos(-1.0) / 3.0);
}

}  // namespace
}  // namespace lightsweep
