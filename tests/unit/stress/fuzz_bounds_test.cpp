// What must hold of the bounds: they are next to nothing where a picture is well conditioned, and grow where a rounding
// shows: in sharp highlights, at rims of lights and cones, on slivers.
#include "bench/stress/fuzz_bounds.h"

#include "bench/stress/test_scenes.h"
#include "renderer/reference/cast_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr int kSize = 5;
constexpr size_t kMiddle = 12;

struct Plane {
    Scene scene;
    Visibility visible;
    std::vector<ReferenceSurface> surfaces;

    explicit Plane(const Material& material, double size = 10.0)
        : scene(facing_plane(material, size, 2.0)),
          visible(cast_visibility(scene, scene.camera, kSize, kSize)),
          surfaces(reference_surfaces(scene, scene.camera, visible)) {}

    // In the middle pixel: how far rounding moves it, relative to what it is.
    double movement(const Light& light) const {
        const auto lights = lights_in_float(std::vector{light}, scene.camera.eye);
        const BoundedRadiance bounded =
            bounded_radiance(scene, surfaces, shading_steps(surfaces), kSize, kSize, lights);
        return bounded.movement[kMiddle] / bounded.radiance[kMiddle].x;
    }
};

Material lambert() { return {.name = "", .model = ShadingModel::lambert}; }
Material mirror() { return {.name = "", .model = ShadingModel::ggx, .roughness = 0.05F, .metallic = 1.0F}; }

TEST(BoundedRadiance, HardlyMovesWhereNothingIsSharp) {
    const Plane plane(lambert());
    EXPECT_LT(plane.movement(sun({0.0, 0.3, -1.0}, glm::dvec3(1.0))), 1e-6);
    EXPECT_LT(plane.movement(point_light({0.0, 0.0, 1.0}, 10.0, glm::dvec3(1.0))), 2e-6);
}

TEST(BoundedRadiance, MovesWhereAHighlightIsSharp) {
    // Half vector 0.003 beside the normal, alpha 0.0025: D changes by some 1 / alpha for each radian.
    const double sharp = Plane(mirror()).movement(sun({0.0, 0.006, -1.0}, glm::dvec3(1.0)));
    EXPECT_GT(sharp, 100.0 * kRoundings);
    EXPECT_LT(sharp, 4000.0 * kRoundings);
}

TEST(BoundedRadiance, MovesAtTheRimOfALight) {
    // The window is (1 - t^4)^2 with t = d / r: 8 t^4 / (1 - t^4) for each part of the radius, t = 0.999.
    const double rim = Plane(lambert()).movement(point_light({0.0, 0.0, 0.999}, 1.0, glm::dvec3(1.0)));
    EXPECT_GT(rim, 8.0 / 0.004 * kRoundings * 0.9);
}

TEST(BoundedRadiance, MovesInANarrowCone) {
    Light spot = spot_light({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 10.0, 1.0, glm::dvec3(1.0));
    spot.inner_deg = 0.0;
    // Beside the axis, share = (cosine - cos 1 deg) / (1 - cos 1 deg): each rounding counts 6566 times.
    spot.direction = glm::normalize(glm::dvec3(0.01, 0.0, -1.0));
    EXPECT_GT(Plane(lambert()).movement(spot), 1000.0 * kRoundings);
}

TEST(InterpolationSteps, GrowAsTrianglesBecomeNarrow) {
    const Plane wide(lambert());
    Scene narrow = wide.scene;
    narrow.instances[0].transform = glm::dmat4(1.0);
    narrow.instances[0].transform[0] *= 1e-3;  // 0.01 units wide: a fiftieth of a pixel
    const auto visible = cast_visibility(narrow, narrow.camera, kSize, kSize);
    const auto surfaces = reference_surfaces(narrow, narrow.camera, visible);
    ASSERT_TRUE(surfaces[kMiddle].covered);
    const auto steps = interpolation_steps(wide.scene, wide.scene.camera, wide.visible, wide.surfaces);
    const auto narrow_steps = interpolation_steps(narrow, narrow.camera, visible, surfaces);
    EXPECT_LT(steps[kMiddle].position, 100.0 * kRoundings);
    EXPECT_GT(narrow_steps[kMiddle].position, 100.0 * steps[kMiddle].position);
}

TEST(RebuildingSteps, GrowAsTrianglesAreSeenEdgeOn) {
    Plane plane(lambert());
    const auto facing = rebuilding_steps(plane.scene, plane.scene.camera, plane.visible, plane.surfaces);
    plane.scene.camera.eye = {0.0, -3.0, 0.003};
    plane.scene.camera.up = {0.0, 0.0, 1.0};
    const auto visible = cast_visibility(plane.scene, plane.scene.camera, kSize, kSize);
    const auto surfaces = reference_surfaces(plane.scene, plane.scene.camera, visible);
    ASSERT_TRUE(surfaces[kMiddle].covered);
    const auto edge_on = rebuilding_steps(plane.scene, plane.scene.camera, visible, surfaces);
    EXPECT_GT(edge_on[kMiddle].position, 100.0 * facing[kMiddle].position);
}

TEST(LightsInFloat, StandRelativeToTheEye) {
    const glm::dvec3 eye(1e6 + 0.125, 0.0, 0.0);
    const auto lights =
        lights_in_float(std::vector{point_light({1e6 + 0.375, 1.0 / 3.0, 0.0}, 0.1, glm::dvec3(1.0))}, eye);
    EXPECT_EQ(lights[0].position.x, 0.25);
    EXPECT_EQ(lights[0].position.y, double{1.0F / 3.0F});
    EXPECT_EQ(lights[0].radius, double{0.1F});
}

}  // namespace
}  // namespace lightsweep
