// Every generated shape: closed, facing outward, of the volume or area that geometry says, with tangents along u.
#include "renderer/scene/shapes.h"

#include "tests/unit/scene/scene_fixtures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace lightsweep {
namespace {

constexpr double kPi = std::numbers::pi;

struct Case {
    const char* name;
    Geometry geometry;
    bool closed;
    double volume;  // of the faceted body; meaningless when not closed
};

// An inscribed regular polygon with n corners has n/2 sin(2 pi / n) of the square of its radius as its area.
double polygon_area(int corners) { return 0.5 * corners * std::sin(2.0 * kPi / corners); }

// A sphere of stacked frusta over polygons: h/3 (A1 + A2 + sqrt(A1 A2)) each.
double faceted_sphere_volume(int segments, int rings) {
    double volume = 0.0;
    for (int j = 0; j < rings; ++j) {
        const double r1 = std::sin(kPi * j / rings);
        const double r2 = std::sin(kPi * (j + 1) / rings);
        const double height = std::cos(kPi * j / rings) - std::cos(kPi * (j + 1) / rings);
        volume += polygon_area(segments) * height / 3.0 * (r1 * r1 + r2 * r2 + r1 * r2);
    }
    return volume;
}

std::vector<Case> all_shapes() {
    std::vector<Case> all;
    all.push_back({"plane", make_shape(PlaneShape{.size = {3, 5}, .segments = {2, 7}}), false, 0});
    all.push_back({"quad", make_shape(QuadShape{.size = {3, 5}, .segments = {3, 1}}), false, 0});
    all.push_back({"box", make_shape(BoxShape{.size = {1, 2, 3}, .segments = 3}), true, 6.0});
    all.push_back({"sphere", make_shape(SphereShape{.radius = 1.0, .segments = 24, .rings = 12}), true,
                   faceted_sphere_volume(24, 12)});
    all.push_back({"cylinder", make_shape(CylinderShape{.radius = 2.0, .height = 3.0, .segments = 10}), true,
                   polygon_area(10) * 4.0 * 3.0});
    all.push_back({"cone", make_shape(ConeShape{.radius = 2.0, .height = 3.0, .segments = 10}), true,
                   polygon_area(10) * 4.0 * 3.0 / 3.0});
    // Pappus: the area of the tube's polygon times the way of its centre, here along chords: 2 n sin(pi/n) times the
    // cosine that every wedge loses, together n sin(2 pi / n).
    all.push_back({"torus", make_shape(TorusShape{.radius = 2.0, .tube = 0.5, .segments = 20, .sides = 12}), true,
                   polygon_area(12) * 0.25 * 20 * std::sin(2.0 * kPi / 20) * 2.0});
    all.push_back({"column", make_shape(ColumnShape{.radius = 0.5, .height = 5.0}), false, 0});
    // A corner of the outline lies at atan2(2, 2) = 1/8 turn, so 8 segments are 2, 4 and 2, all of 1/16 turn.
    all.push_back({"arch", make_shape(ArchShape{.span = 2, .width = 4, .height = 2, .depth = 0.5, .segments = 8}), true,
                   (4.0 * 2.0 - 0.5 * polygon_area(16)) * 0.5});
    return all;
}

std::vector<Case> closed_shapes() {
    std::vector<Case> shapes = all_shapes();
    std::erase_if(shapes, [](const Case& shape) { return !shape.closed; });
    return shapes;
}

using Point = std::tuple<float, float, float>;
Point point(const Vertex& v) { return {v.position.x, v.position.y, v.position.z}; }

class EveryShape : public testing::TestWithParam<Case> {};
class ClosedShape : public EveryShape {};

TEST_P(EveryShape, HasSoundFrames) { expect_sound_frames(GetParam().geometry.vertices, GetParam().geometry.indices); }

TEST_P(EveryShape, IsClosedWhereItClaimsToBe) {
    const Geometry& g = GetParam().geometry;
    std::map<std::pair<Point, Point>, int> edges;
    for (size_t i = 0; i < g.indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k) {
            ++edges[{point(g.vertices[g.indices[i + k]]), point(g.vertices[g.indices[i + (k + 1) % 3]])}];
        }
    }
    int open = 0;
    for (const auto& [edge, count] : edges) {
        if (!edges.contains({edge.second, edge.first})) ++open;
        if (GetParam().closed) {
            EXPECT_EQ(count, 1);
        }
    }
    if (GetParam().closed) {
        EXPECT_EQ(open, 0);
    } else {
        EXPECT_GT(open, 0);
    }
}

// The divergence theorem: the sum of signed tetrahedra is the volume, and positive only when the front is outside.
TEST_P(ClosedShape, EnclosesItsVolume) {
    const Geometry& g = GetParam().geometry;
    double volume = 0.0;
    for (size_t i = 0; i < g.indices.size(); i += 3) {
        const glm::dvec3 a = g.vertices[g.indices[i]].position;
        const glm::dvec3 b = g.vertices[g.indices[i + 1]].position;
        const glm::dvec3 c = g.vertices[g.indices[i + 2]].position;
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    EXPECT_NEAR(volume, GetParam().volume, 1e-5 * GetParam().volume);
}

// Seen from the front the image is upright and not mirrored: u grows along the tangent, v against the bitangent.
TEST_P(EveryShape, TangentsFollowTextureCoordinates) {
    const Geometry& g = GetParam().geometry;
    for (size_t i = 0; i < g.indices.size(); i += 3) {
        const Vertex& a = g.vertices[g.indices[i]];
        const Vertex& b = g.vertices[g.indices[i + 1]];
        const Vertex& c = g.vertices[g.indices[i + 2]];
        const glm::dvec2 uv1 = glm::dvec2(b.uv) - glm::dvec2(a.uv);
        const glm::dvec2 uv2 = glm::dvec2(c.uv) - glm::dvec2(a.uv);
        const double area = uv1.x * uv2.y - uv2.x * uv1.y;
        ASSERT_LT(area, 0.0) << "mirrored triangle " << i / 3;
        const glm::dvec3 edge1 = glm::dvec3(b.position) - glm::dvec3(a.position);
        const glm::dvec3 edge2 = glm::dvec3(c.position) - glm::dvec3(a.position);
        const glm::dvec3 along_u = (edge1 * uv2.y - edge2 * uv1.y) / area;
        const glm::dvec3 along_v = (edge2 * uv1.x - edge1 * uv2.x) / area;
        const glm::dvec3 tangent = glm::dvec3(a.tangent) + glm::dvec3(b.tangent) + glm::dvec3(c.tangent);
        const glm::dvec3 normal = glm::dvec3(a.normal) + glm::dvec3(b.normal) + glm::dvec3(c.normal);
        ASSERT_GT(glm::dot(along_u, tangent), 0.0) << "triangle " << i / 3;
        ASSERT_LT(glm::dot(along_v, glm::cross(normal, tangent)), 0.0) << "triangle " << i / 3;
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryShape, testing::ValuesIn(all_shapes()),
                         [](const auto& each) { return each.param.name; });
INSTANTIATE_TEST_SUITE_P(All, ClosedShape, testing::ValuesIn(closed_shapes()),
                         [](const auto& each) { return each.param.name; });

TEST(Shapes, SphereNormalsAreExact) {
    for (const Vertex& v : make_shape(SphereShape{.radius = 3.0}).vertices) {
        EXPECT_NEAR(glm::length(v.normal - v.position / 3.0F), 0.0, 1e-6);
    }
}

// The fluted shaft has no closed form to look up; finite differences of its own surface stand in: with a fine mesh, the
// triangles' normals come near to the analytic ones, quadratically closer than with a coarse one.
TEST(Shapes, ColumnNormalsMatchItsSurface) {
    const auto worst_angle = [](int tessellation, int rows) {
        const Geometry g = make_shape(ColumnShape{.flutes = 6, .tessellation = tessellation, .rows = rows});
        double worst = 0.0;
        for (size_t i = 0; i < g.indices.size(); i += 3) {
            const Vertex& a = g.vertices[g.indices[i]];
            const Vertex& b = g.vertices[g.indices[i + 1]];
            const Vertex& c = g.vertices[g.indices[i + 2]];
            const glm::dvec3 face = glm::normalize(glm::cross(glm::dvec3(b.position) - glm::dvec3(a.position),
                                                              glm::dvec3(c.position) - glm::dvec3(a.position)));
            const glm::dvec3 mean = glm::normalize(glm::dvec3(a.normal) + glm::dvec3(b.normal) + glm::dvec3(c.normal));
            worst = std::max(worst, glm::length(face - mean));
        }
        return worst;
    };
    const double coarse = worst_angle(8, 50);
    const double fine = worst_angle(32, 200);
    EXPECT_LT(fine, 0.05);
    EXPECT_LT(fine, 0.5 * coarse);
}

TEST(Shapes, ColumnStandsOnTheGroundAndIsAsTallAsAsked) {
    Bounds bounds;
    for (const Vertex& v : make_shape(ColumnShape{.radius = 0.5, .height = 5.0}).vertices) bounds.include(v.position);
    EXPECT_EQ(bounds.low.y, 0.0);
    EXPECT_EQ(bounds.high.y, 5.0);
    EXPECT_NEAR(bounds.size().x, 2.8 * 0.5, 1e-6);
}

}  // namespace
}  // namespace lightsweep
