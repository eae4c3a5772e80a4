// The surface under a pixel: where the ray meets it, and its shading normal under every kind of transform.
#include "renderer/scene/shapes.h"
#include "tests/unit/reference/fixtures.h"
#include "tests/unit/reference/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace lightsweep {
namespace {

void expect_vector(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-14) {
    EXPECT_LE(glm::distance(value, expected), tolerance)
        << testing::PrintToString(value) << " is not " << testing::PrintToString(expected);
}

// A slab of spheres and boxes under odd transforms, seen from an odd place.
Scene crowded_scene() {
    Scene scene;
    Random random(2);
    const auto geometry = make_shape(SphereShape{.radius = 0.5, .segments = 12, .rings = 8});
    for (int i = 0; i < 12; ++i) {
        glm::dmat4 transform =
            glm::translate(glm::dmat4(1.0), {random.uniform(-2, 2), random.uniform(-1.5, 1.5), random.uniform(-1, 1)});
        transform = glm::rotate(transform, random.uniform(0.0, 6.0), random_direction(random));
        transform = glm::scale(transform, {random.uniform(0.5, 2), random.uniform(0.5, 2), i % 2 == 0 ? 1 : -1});
        add_mesh(scene, geometry.vertices, geometry.indices, transform);
    }
    add_quad(scene, glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(3.0)), {0, 0, -1}));
    return scene;
}

constexpr Camera kCrowdedCamera{.eye = {0.75, 0.5, 4.0}, .target = {0.0, 0.125, 0.0}, .fov_y_deg = 55.0};

TEST(Surfaces, RayOfEachPixelMeetsThePlane) {
    Scene scene;
    add_quad(scene, glm::scale(glm::dmat4(1.0), glm::dvec3(10.0)));
    const int n = 5;
    const auto surfaces = reference_surfaces(scene, kFrontCamera, first_triangle_everywhere(n, n));
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const glm::dvec3 expected(4.0 * ((2 * x + 1.0) / n - 1.0), 4.0 * (1.0 - (2 * y + 1.0) / n), -4.0);
            expect_vector(surfaces[static_cast<size_t>(y * n + x)].position, expected);
        }
    }
}

TEST(Surfaces, WidePicturesSeeMoreToTheSides) {
    Scene scene;
    add_quad(scene);
    const auto surfaces = reference_surfaces(scene, kFrontCamera, first_triangle_everywhere(6, 2));
    expect_vector(surfaces[0].position, {-4.0 * 2.5, 4.0 * 0.5, -4.0});
    expect_vector(surfaces[11].position, {4.0 * 2.5, -4.0 * 0.5, -4.0});
}

TEST(Surfaces, BackgroundIsNotCovered) {
    Scene scene;
    add_quad(scene);
    Visibility visible = first_triangle_everywhere(2, 1);
    visible.triangles[1] = {};
    const auto surfaces = reference_surfaces(scene, kFrontCamera, visible);
    EXPECT_TRUE(surfaces[0].covered);
    EXPECT_FALSE(surfaces[1].covered);
}

TEST(Surfaces, VertexNormalsAreMadeUnitBeforeTheyAreInterpolated) {
    // The middle of the triangle (-1, -1), (3, -1), (-1, 3) at (0, 0): weights 1/2, 1/4, 1/4. Lengths do not count.
    Scene scene;
    const double s = std::sqrt(0.5);
    add_mesh(
        scene,
        {vertex_at({-1, -1, 0}, {0, 0, 5}), vertex_at({3, -1, 0}, {2, 0, 2}), vertex_at({-1, 3, 0}, {0, 0.25F, 0})},
        {0, 1, 2});
    const glm::dvec3 sum = 0.5 * glm::dvec3(0, 0, 1) + 0.25 * glm::dvec3(s, 0, s) + 0.25 * glm::dvec3(0, 1, 0);
    expect_vector(middle_surface(scene).normal, glm::normalize(sum));
}

TEST(Surfaces, NormalsThatCancelOutAreTheTriangles) {
    for (const bool mirrored : {false, true}) {
        Scene scene;
        add_mesh(
            scene,
            {vertex_at({-1, -1, 0}, {1, 0, 0}), vertex_at({3, -1, 0}, {-1, 0, 0}), vertex_at({-1, 3, 0}, {-1, 0, 0})},
            {0, 1, 2}, glm::scale(glm::dmat4(1.0), {1, 1, mirrored ? -1 : 1}));
        // Mirrored along its normal, the triangle stays where it is and shows its other side.
        const glm::dvec3 front(0, 0, mirrored ? -1 : 1);
        EXPECT_EQ(middle_surface(scene).normal, front);
        for (auto& vertex : scene.vertices) vertex.normal = glm::vec3(0.0F);
        EXPECT_EQ(middle_surface(scene).normal, front);
    }
}

// --- Transforms ---

TEST(Surfaces, ScaledInstanceTiltsNormalsTheOtherWay) {
    Scene scene;
    add_quad(scene, glm::scale(glm::dmat4(1.0), {1, 1, 4}), {}, {0, 1, 1});
    expect_vector(middle_surface(scene).normal, glm::normalize(glm::dvec3(0, 1, 0.25)), 1e-14);
}

TEST(Surfaces, ScaleAloneChangesNoNormal) {
    for (const double scale : {1e-12, 1e-3, 1.0, 1e6}) {
        Scene scene;
        add_quad(scene, glm::scale(glm::dmat4(1.0), glm::dvec3(scale)), {}, {1, 2, 2});
        expect_vector(middle_surface(scene).normal, glm::dvec3(1, 2, 2) / 3.0);
    }
}

TEST(Surfaces, MirroredInstanceMirrorsNormals) {
    Scene scene;
    add_quad(scene, glm::scale(glm::dmat4(1.0), {-1, 1, 1}), {}, {1, 0, 1});
    expect_vector(middle_surface(scene).normal, glm::normalize(glm::dvec3(-1, 0, 1)));
}

TEST(Surfaces, FlattenedInstanceHasTheNormalOfItsPlane) {
    Scene scene;  // singular: it has no inverse
    add_quad(scene, glm::scale(glm::dmat4(1.0), {1, 1, 0}), {}, {1, 0, 1});
    expect_vector(middle_surface(scene).normal, {0, 0, 1});
}

TEST(Surfaces, DoubleSidedOnesFaceTheViewer) {
    Camera behind = kFrontCamera;
    behind.eye.z = -4.0;
    for (const bool double_sided : {false, true}) {
        for (const double mirror : {1.0, -1.0}) {
            Scene scene;
            add_quad(scene, glm::scale(glm::dmat4(1.0), {mirror, 1, 1}),
                     {.name = "sheet", .double_sided = double_sided});
            EXPECT_EQ(middle_surface(scene).normal, glm::dvec3(0, 0, 1)) << "mirror " << mirror;
            EXPECT_EQ(middle_surface(scene, behind).normal, glm::dvec3(0, 0, double_sided ? -1 : 1))
                << "mirror " << mirror;
        }
    }
}

// --- Normal maps ---

SampledTexels texels_with(const glm::vec3& normal) {
    return {.base_color = {1, 1, 1}, .roughness = 1, .normal = normal, .metallic = 1, .emissive = {1, 1, 1}};
}

TEST(NormalMap, AxesAreTangentBitangentAndNormal) {
    Scene scene;
    add_quad(scene, glm::dmat4(1.0), {.name = "bumpy", .normal_texture = 0});
    const auto mapped = [&](const glm::vec3& texel) {
        return middle_surface(scene, kFrontCamera, {texels_with(texel)}).normal;
    };
    expect_vector(mapped({0.5F, 0.5F, 1}), {0, 0, 1});
    expect_vector(mapped({1, 0.5F, 0.5F}), {1, 0, 0});
    expect_vector(mapped({0.5F, 1, 0.5F}), {0, 1, 0});
    expect_vector(mapped({1, 0.5F, 1}), glm::normalize(glm::dvec3(1, 0, 1)));
    expect_vector(mapped({0.5F, 0.5F, 0.5F}), {0, 0, 1}, 0.0);  // no direction: the surface's own

    for (auto& vertex : scene.vertices) vertex.tangent.w = -1;
    expect_vector(mapped({0.5F, 1, 0.5F}), {0, -1, 0});
    scene.materials[0].normal_scale = 0.25F;
    expect_vector(mapped({1, 0.5F, 1}), glm::normalize(glm::dvec3(0.25, 0, 1)));
}

TEST(NormalMap, MirrorsWithItsInstance) {
    // Mirrored in x: the tangent turns round, the bitangent stays up.
    Scene scene;
    add_quad(scene, glm::scale(glm::dmat4(1.0), {-1, 1, 1}), {.name = "bumpy", .normal_texture = 0});
    expect_vector(middle_surface(scene, kFrontCamera, {texels_with({1, 0.5F, 0.5F})}).normal, {-1, 0, 0});
    expect_vector(middle_surface(scene, kFrontCamera, {texels_with({0.5F, 1, 0.5F})}).normal, {0, 1, 0});
}

TEST(NormalMap, BendsByItsAngleWhateverTheTangent) {
    const glm::vec3 texel(0.75F, 0.5F, 1.0F);  // (1/2, 0, 1)
    for (const glm::vec4& tangent : {glm::vec4(0, 0, 0, 1), glm::vec4(0, 0, 2, 1), glm::vec4(0, 0, -1, -1),
                                     glm::vec4(std::numeric_limits<float>::quiet_NaN())}) {
        Scene scene;
        add_quad(scene, glm::dmat4(1.0), {.name = "bumpy", .normal_texture = 0});
        for (auto& vertex : scene.vertices) vertex.tangent = tangent;
        const glm::dvec3 normal = middle_surface(scene, kFrontCamera, {texels_with(texel)}).normal;
        EXPECT_NEAR(normal.z, 1.0 / std::sqrt(1.25), 1e-14);
        EXPECT_NEAR(glm::length(normal), 1.0, 1e-14);
    }
}

TEST(NormalMap, FilteredToNothingSaysNothing) {
    Scene scene;
    add_quad(scene, glm::dmat4(1.0), {.name = "bumpy", .normal_texture = 0});
    expect_vector(middle_surface(scene, kFrontCamera, {texels_with({0.50002F, 0.5F, 0.5F})}).normal, {0, 0, 1});
}

TEST(NormalMap, IsOfMaterialsThatHaveOne) {
    Scene scene;
    add_quad(scene);
    expect_vector(middle_surface(scene, kFrontCamera, {texels_with({1, 0.5F, 0.5F})}).normal, {0, 0, 1});
}

// --- Materials ---

TEST(Surfaces, FactorsMultiplyTexels) {
    Scene scene;
    add_quad(scene, glm::dmat4(1.0),
             {.name = "all factors",
              .model = ShadingModel::blinn_phong,
              .base_color = {0.5F, 0.25F, 1},
              .roughness = 0.5F,
              .metallic = 0.75F,
              .specular = {0.5F, 0.25F, 0.125F},
              .emissive = {1, 2, 3}});
    const SampledTexels texels{
        .base_color = {0.5F, 1, 0.25F}, .roughness = 0.5F, .normal = {}, .metallic = 0.5F, .emissive = {2, 1, 0}};
    auto s = middle_surface(scene, kFrontCamera, {texels});
    EXPECT_EQ(s.model, ShadingModel::blinn_phong);
    EXPECT_EQ(s.base_color, glm::dvec3(0.25));
    EXPECT_EQ(s.roughness, 0.25);
    EXPECT_EQ(s.metallic, 0.375);
    EXPECT_EQ(s.specular, glm::dvec3(0.5, 0.25, 0.125));
    EXPECT_EQ(s.emissive, glm::dvec3(2, 2, 0));
    scene.materials[0].specular_from_luminance = true;  // of a grey: the grey
    expect_vector(middle_surface(scene, kFrontCamera, {texels}).specular, 0.25 * glm::dvec3(0.5, 0.25, 0.125));
    scene.materials[0].base_color = {0, 1, 0};
    expect_vector(middle_surface(scene).specular, 0.7152 * glm::dvec3(0.5, 0.25, 0.125));
}

// --- Hard places ---

TEST(Surfaces, StayFiniteOnDegenerateTriangles) {
    const auto expect_finite = [](const ReferenceSurface& s) {
        EXPECT_TRUE(s.covered);
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(s.position[c]) && std::isfinite(s.normal[c]));
        EXPECT_LT(glm::length(s.position), 300.0);
    };
    const std::vector<std::array<glm::vec3, 3>> triangles{
        {{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}},             // a point
        {{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}},            // a line
        {{{0, -1, 0}, {0, 1, 0}, {0, 0, -1}}},           // seen edge-on
        {{{-1, 0, 8}, {1, 0, 8}, {0, 1, 9}}},            // behind the eye
        {{{-1, 1e-7F, 0}, {1, 1e-7F, 0}, {0, 0, -50}}},  // nearly edge-on
    };
    for (const auto& [a, b, c] : triangles) {
        Scene scene;
        add_mesh(scene, {vertex_at(a), vertex_at(b), vertex_at(c)}, {0, 1, 2});
        for (const int bits : {0, 8, 24})
            expect_finite(reference_surfaces(scene, kFrontCamera, first_triangle_everywhere(1, 1), bits).front());
    }
}

TEST(Surfaces, DoNotMoveWithTheOrigin) {
    Scene scene = crowded_scene();
    const auto visible = cast_visibility(scene, kCrowdedCamera, 64, 48);
    const auto near_origin = reference_surfaces(scene, kCrowdedCamera, visible);
    const glm::dvec3 shift(1e6, -1e6, 1e6);
    for (auto& instance : scene.instances) instance.transform[3] += glm::dvec4(shift, 0.0);
    Camera camera = kCrowdedCamera;
    camera.eye += shift;
    camera.target += shift;
    const auto far_away = reference_surfaces(scene, camera, visible);
    for (size_t i = 0; i < far_away.size(); ++i) {
        ASSERT_EQ(far_away[i].covered, near_origin[i].covered);
        // Where an instance stands is rounded to 1e-10 there; a grazing plane multiplies that.
        expect_vector(far_away[i].position, near_origin[i].position, 1e-7);
        expect_vector(far_away[i].normal, near_origin[i].normal, 1e-7);
    }
}

TEST(Surfaces, AreTheSameForAnyNumberOfThreads) {
    const Scene scene = crowded_scene();
    const auto visible = cast_visibility(scene, kCrowdedCamera, 64, 48);
    const auto compute = [&] { return reference_surfaces(scene, kCrowdedCamera, visible); };
    const auto on_all = compute();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto on_one = compute();
    for (size_t i = 0; i < on_all.size(); ++i) {
        EXPECT_EQ(on_one[i].position, on_all[i].position);
        EXPECT_EQ(on_one[i].normal, on_all[i].normal);
    }
}

// --- Snapping ---

// How far, in pixels along an axis, from its pixel's centre a surface of crowded_scene() is seen; the largest.
double largest_shift(int bits, int size) {
    const Scene scene = crowded_scene();
    Camera camera = kFrontCamera;
    camera.fov_y_deg = 60.0;
    const auto surfaces = reference_surfaces(scene, camera, cast_visibility(scene, camera, size, size), bits);
    double largest = 0.0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const ReferenceSurface& s = surfaces[static_cast<size_t>(y * size + x)];
            if (!s.covered) continue;
            const double scale = 0.5 * size * std::sqrt(3.0) / -s.position.z;
            largest = std::max({largest, std::abs(0.5 * size + s.position.x * scale - (x + 0.5)),
                                std::abs(0.5 * size - s.position.y * scale - (y + 0.5))});
        }
    }
    return largest;
}

TEST(Snapping, MovesSurfacesByHalfAStepOfTheGridAtMost) {
    EXPECT_LT(largest_shift(0, 96), 1e-12);
    EXPECT_LT(largest_shift(24, 96), 0x1p-24);
    // Half a step where a pixel's centre is inside of the snapped triangle; at its edges a little more.
    EXPECT_LT(largest_shift(8, 96), 1.5 * 0x1p-9);
    EXPECT_GT(largest_shift(8, 96), 0x1p-10);
    EXPECT_GT(largest_shift(4, 96), 8.0 * largest_shift(8, 96));
}

TEST(Snapping, LeavesTrianglesThatReachBehindTheEye) {
    Scene scene;
    add_mesh(scene, {vertex_at({-9, -1, 9}), vertex_at({9, -1, 9}), vertex_at({0.3F, -1, -30})}, {0, 1, 2});
    const auto visible = first_triangle_everywhere(4, 4);
    const auto exact = reference_surfaces(scene, kFrontCamera, visible);
    const auto snapped = reference_surfaces(scene, kFrontCamera, visible, 8);
    for (size_t i = 0; i < exact.size(); ++i) EXPECT_EQ(snapped[i].position, exact[i].position);
}

TEST(Snapping, VerticesOnTheGridStayWhereTheyAre) {
    // 8 x 8 pixels, 90 degrees, the quad four units away: its corners are seen at whole pixels.
    Scene scene;
    add_quad(scene);
    const auto visible = first_triangle_everywhere(8, 8);
    const auto exact = reference_surfaces(scene, kFrontCamera, visible);
    const auto snapped = reference_surfaces(scene, kFrontCamera, visible, 1);
    for (size_t i = 0; i < exact.size(); ++i) expect_vector(snapped[i].position, exact[i].position);
}

}  // namespace
}  // namespace lightsweep
