// Generated normals and tangents of geometry that came without.
#include "renderer/scene/geometry.h"

#include "renderer/scene/shapes.h"
#include "tests/unit/scene/scene_fixtures.h"

#include <gtest/gtest.h>

#include <limits>

namespace lightsweep {
namespace {

Vertex vertex(const glm::vec3& position, const glm::vec2& uv) {
    return {.position = position, .normal = {0, 0, 1}, .tangent = glm::vec4(0.0F), .uv = uv};
}

// A unit square that faces +z, in two triangles that share an edge. The image's first row is at the top.
Geometry square(const glm::vec2& top_left, const glm::vec2& bottom_left, const glm::vec2& bottom_right,
                const glm::vec2& top_right) {
    return {.vertices = {vertex({0, 1, 0}, top_left), vertex({0, 0, 0}, bottom_left), vertex({1, 0, 0}, bottom_right),
                         vertex({1, 1, 0}, top_right)},
            .indices = {0, 1, 2, 0, 2, 3}};
}

TEST(Tangents, UprightImageHasTangentToTheRightAndBitangentUp) {
    Geometry g = square({0, 0}, {0, 1}, {1, 1}, {1, 0});
    make_tangents(g);
    ASSERT_EQ(g.vertices.size(), 4U);
    for (const Vertex& v : g.vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, MirroredImageHasTangentToTheLeftAndBitangentUp) {
    Geometry g = square({1, 0}, {1, 1}, {0, 1}, {0, 0});
    make_tangents(g);
    for (const Vertex& v : g.vertices) {
        EXPECT_EQ(v.tangent, glm::vec4(-1, 0, 0, -1));
        const glm::vec3 bitangent = glm::cross(v.normal, glm::vec3(v.tangent)) * v.tangent.w;
        EXPECT_EQ(bitangent, glm::vec3(0, 1, 0));
    }
}

TEST(Tangents, VertexUsedWithBothHandednessesIsSplit) {
    // The image is folded along the middle: u runs 0 to 1 and back to 0.
    Geometry g{.vertices = {vertex({0, 1, 0}, {0, 0}), vertex({0, 0, 0}, {0, 1}), vertex({1, 0, 0}, {1, 1}),
                            vertex({1, 1, 0}, {1, 0}), vertex({2, 0, 0}, {0, 1}), vertex({2, 1, 0}, {0, 0})},
               .indices = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5}};
    const Geometry before = g;
    make_tangents(g);
    EXPECT_EQ(g.vertices.size(), 8U) << "two vertices lie on the fold";
    for (size_t i = 0; i < g.indices.size(); ++i) {
        const Vertex& v = g.vertices[g.indices[i]];
        EXPECT_EQ(v.position, before.vertices[before.indices[i]].position);
        EXPECT_EQ(v.tangent, i < 6 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1));
    }
}

TEST(Tangents, DegenerateCoordinatesStillGiveAFrame) {
    Geometry g = square({0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5});
    make_tangents(g);
    expect_sound_frames(g.vertices, g.indices);
}

TEST(Tangents, OverflowingCoordinatesStillGiveAFrame) {
    const float huge = std::numeric_limits<float>::max();
    Geometry g = square({0, 0}, {0, huge}, {huge, huge}, {huge, 0});
    make_tangents(g);
    expect_sound_frames(g.vertices, g.indices);
}

// A sphere's own tangents are exact; the generated ones only know its triangles, and must agree away from the poles,
// where a whole row of coordinates falls onto one point.
TEST(Tangents, AgreeWithTheSpheresOwn) {
    const Geometry exact = make_shape(SphereShape{.segments = 64, .rings = 32});
    Geometry generated = exact;
    make_tangents(generated);
    ASSERT_EQ(generated.vertices.size(), exact.vertices.size());
    for (size_t i = 0; i < exact.vertices.size(); ++i) {
        if (std::abs(exact.vertices[i].normal.y) > 0.95F) continue;
        EXPECT_LT(glm::length(exact.vertices[i].tangent - generated.vertices[i].tangent), 0.1F);
    }
}

TEST(Tangents, DoNotDependOnHowVerticesAreShared) {
    Geometry shared = make_shape(SphereShape{.segments = 16, .rings = 8});
    Geometry separate;
    for (const uint32_t index : shared.indices) {
        separate.indices.push_back(static_cast<uint32_t>(separate.vertices.size()));
        separate.vertices.push_back(shared.vertices[index]);
    }
    make_tangents(shared);
    make_tangents(separate);
    for (size_t i = 0; i < shared.indices.size(); ++i) {
        EXPECT_EQ(shared.vertices[shared.indices[i]].tangent, separate.vertices[separate.indices[i]].tangent);
    }
}

TEST(FlatNormals, EveryTriangleHasItsOwn) {
    // Two faces of a tetrahedron that share an edge.
    Geometry g{.vertices = {vertex({0, 0, 0}, {}), vertex({1, 0, 0}, {}), vertex({0, 1, 0}, {}), vertex({0, 0, 1}, {})},
               .indices = {0, 2, 1, 0, 1, 3}};
    make_flat_normals(g);
    ASSERT_EQ(g.vertices.size(), 6U);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(g.vertices[g.indices[i]].normal, glm::vec3(0, 0, -1));
    for (size_t i = 3; i < 6; ++i) EXPECT_EQ(g.vertices[g.indices[i]].normal, glm::vec3(0, -1, 0));
}

TEST(Patch, LeavesOutTrianglesWithoutArea) {
    Geometry g;
    add_patch(g, 4, 1, [](double u, double v) {
        return make_vertex({u * v, -v, 0.0}, {0, 0, 1}, {1, 0, 0}, {u, v});  // the upper edge is one point
    });
    EXPECT_EQ(g.indices.size() / 3, 4U);
}

}  // namespace
}  // namespace lightsweep
