// The sequence of lights: prefixes, regularity, statistics, and the two regimes of radius.
#include "renderer/base/random.h"
#include "renderer/scene/scene.h"
#include "tests/unit/scene/scene_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace lightsweep {
namespace {

using testing::HasSubstr;

// A scene of one unit square, twice as large in the world, that faces up at y = 0; no lights yet.
Scene square_scene() {
    Scene scene;
    scene.key = "square";
    const auto vertex = [](float x, float z) {
        return Vertex{.position = {x, 0, z}, .normal = {0, 1, 0}, .tangent = {1, 0, 0, 1}, .uv = {}};
    };
    scene.vertices = {vertex(0, 0), vertex(0, 1), vertex(1, 1), vertex(1, 0)};
    scene.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(Mesh{.name = "square", .first_index = 0, .index_count = 6, .material = 0, .bounds = {}});
    scene.instances.push_back({.mesh = 0, .transform = glm::dmat4(glm::dmat3(2.0))});
    return scene;
}

Scene scene_with(Placement placement, const Bounds& bounds = {{0, 0, 0}, {2, 4, 8}}) {
    Scene scene = square_scene();
    scene.lights.generator = LightGenerator{.placement = placement, .bounds = bounds, .radius = 3.0, .intensity = 5.0};
    return scene;
}

bool same(const Light& a, const Light& b) {
    return a.kind == b.kind && a.position == b.position && a.direction == b.direction && a.color == b.color &&
           a.radius == b.radius && a.inner_deg == b.inner_deg && a.outer_deg == b.outer_deg;
}

class EveryPlacement : public testing::TestWithParam<Placement> {};
INSTANTIATE_TEST_SUITE_P(All, EveryPlacement, testing::Values(Placement::grid, Placement::random, Placement::surface));

TEST_P(EveryPlacement, FirstLightsAreTheSameForEveryCount) {
    Scene scene = scene_with(GetParam());
    scene.lights.fixed = {Light{.position = {7, 7, 7}}, Light{.position = {8, 8, 8}}};
    scene.lights.generator->spot_share = 0.5;
    const auto all = make_lights(scene, 100, {});
    ASSERT_EQ(all.size(), 100U);
    EXPECT_EQ(all[0].position, glm::dvec3(7.0)) << "the written lights come first";
    for (const int count : {0, 1, 2, 3, 17, 64}) {
        const auto some = make_lights(scene, count, {});
        ASSERT_EQ(some.size(), static_cast<size_t>(count));
        for (size_t i = 0; i < some.size(); ++i) EXPECT_TRUE(same(some[i], all[i])) << count << " lights, light " << i;
    }
}

TEST_P(EveryPlacement, SeedChangesTheLights) {
    Scene scene = scene_with(GetParam());
    const Light before = make_lights(scene, 1, {})[0];
    scene.lights.generator->seed = 2;
    EXPECT_FALSE(same(before, make_lights(scene, 1, {})[0]));
}

// With the constant-overlap regime positions and hues stay, and the lit level too: intensity follows the square of the
// radius, which an inverse-square law needs to look the same at a smaller scale.
TEST_P(EveryPlacement, OverlapChangesRadiusAndIntensityAlone) {
    const Scene scene = scene_with(GetParam());
    const auto fixed = make_lights(scene, 500, {});
    const auto shrunk = make_lights(scene, 500, {.overlap = 2.0});
    for (size_t i = 0; i < fixed.size(); ++i) {
        EXPECT_EQ(fixed[i].radius, 3.0);
        EXPECT_LT(shrunk[i].radius, 3.0);
        EXPECT_EQ(fixed[i].position, shrunk[i].position);
        const double ratio = shrunk[i].radius / fixed[i].radius;
        EXPECT_NEAR(glm::length(shrunk[i].color - fixed[i].color * ratio * ratio), 0.0, 1e-12);
    }
}

TEST_P(EveryPlacement, RadiusNeverGrowsPastTheGenerators) {
    for (const Light& light : make_lights(scene_with(GetParam()), 2, {.overlap = 1e6})) EXPECT_EQ(light.radius, 3.0);
}

TEST(Lights, ColoursHaveTheIntensityAndSaturationAskedFor) {
    Scene scene = scene_with(Placement::random);
    scene.lights.generator->saturation = 0.75;
    std::set<int> brightest;
    for (const Light& light : make_lights(scene, 200, {})) {
        const double high = std::max({light.color.r, light.color.g, light.color.b});
        const double low = std::min({light.color.r, light.color.g, light.color.b});
        EXPECT_NEAR(high, 5.0, 1e-12);
        EXPECT_NEAR(low, 5.0 * 0.25, 1e-12);
        for (int k = 0; k < 3; ++k) {
            if (light.color[k] == high) brightest.insert(k);
        }
    }
    EXPECT_EQ(brightest.size(), 3U) << "every hue occurs";
}

TEST(Lights, SpotShareIsKept) {
    Scene scene = scene_with(Placement::random);
    scene.lights.generator->spot_share = 0.25;
    int spots = 0;
    for (const Light& light : make_lights(scene, 4000, {})) {
        spots += light.kind == LightKind::spot ? 1 : 0;
        EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
        EXPECT_LE(light.direction.y, 0.0);
    }
    EXPECT_NEAR(spots / 4000.0, 0.25, 5.0 * std::sqrt(0.25 * 0.75 / 4000.0)) << "five standard deviations";
}

// The first 2^(dk) lights have 2^k distinct, evenly spaced coordinates along each of d axes, all combinations once.
void expect_regular_grid(const Bounds& bounds, int dimensions, int level) {
    const int per_axis = 1 << level;
    const int count = static_cast<int>(std::lround(std::pow(per_axis, dimensions)));
    const auto lights = make_lights(scene_with(Placement::grid, bounds), count, {});
    std::set<std::array<long, 3>> cells;
    for (const Light& light : lights) {
        std::array<long, 3> cell{};
        for (int k = 0; k < 3; ++k) {
            ASSERT_GE(light.position[k], bounds.low[k]);
            ASSERT_LE(light.position[k], bounds.high[k]);
            if (bounds.size()[k] == 0.0) continue;
            const double spacing = bounds.size()[k] / per_axis;
            const double offset = (light.position[k] - lights[0].position[k]) / spacing;
            EXPECT_NEAR(offset, std::round(offset), 1e-9) << "off the grid";
            cell[static_cast<size_t>(k)] = std::lround(std::floor((light.position[k] - bounds.low[k]) / spacing));
        }
        cells.insert(cell);
    }
    EXPECT_EQ(cells.size(), lights.size()) << "one light per cell";
}

TEST(GridLights, FillRegularGridsInThreeDimensions) {
    for (int level = 0; level <= 4; ++level) expect_regular_grid({{-1, 0, 2}, {3, 1, 4}}, 3, level);
}

TEST(GridLights, FillRegularGridsInAPlaneWhenTheBoundsAreFlat) {
    for (int level = 0; level <= 5; ++level) expect_regular_grid({{-1, 2, 2}, {3, 2, 4}}, 2, level);
}

TEST(GridLights, FillARegularLine) {
    for (int level = 0; level <= 5; ++level) expect_regular_grid({{-1, 2, 2}, {-1, 2, 4}}, 1, level);
}

TEST(RandomLights, StayInBoundsAndFillThemEvenly) {
    const auto lights = make_lights(scene_with(Placement::random), 4000, {});
    glm::dvec3 mean(0.0);
    for (const Light& light : lights) {
        for (int k = 0; k < 3; ++k) {
            ASSERT_GE(light.position[k], 0.0);
            ASSERT_LE(light.position[k], (k == 0 ? 2.0 : k == 1 ? 4.0 : 8.0));
        }
        mean += light.position / 4000.0;
    }
    // The mean of n uniform numbers in [0, s] has a standard deviation of s / sqrt(12 n).
    EXPECT_NEAR(mean.x, 1.0, 5.0 * 2.0 / std::sqrt(12 * 4000.0));
    EXPECT_NEAR(mean.y, 2.0, 5.0 * 4.0 / std::sqrt(12 * 4000.0));
    EXPECT_NEAR(mean.z, 4.0, 5.0 * 8.0 / std::sqrt(12 * 4000.0));
}

TEST(SurfaceLights, StandAboveTheFrontAtTheHeightsAskedFor) {
    Scene scene = scene_with(Placement::surface);
    scene.lights.generator->height_min = 0.1;
    scene.lights.generator->height_max = 0.3;
    double mean_x = 0.0;
    for (const Light& light : make_lights(scene, 2000, {})) {
        EXPECT_GE(light.position.y, 0.1 - 1e-12);
        EXPECT_LE(light.position.y, 0.3 + 1e-12);
        EXPECT_GE(std::min(light.position.x, light.position.z), 0.0);
        EXPECT_LE(std::max(light.position.x, light.position.z), 2.0);
        EXPECT_EQ(light.direction, glm::dvec3(0, -1, 0)) << "a spot would shine on its surface";
        mean_x += light.position.x / 2000.0;
    }
    EXPECT_NEAR(mean_x, 1.0, 5.0 * 2.0 / std::sqrt(12 * 2000.0));
}

// Mirroring turns the winding around, and the front with it.
TEST(SurfaceLights, StayOnTheFrontOfMirroredInstances) {
    Scene scene = scene_with(Placement::surface);
    scene.instances[0].transform = glm::dmat4(glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1));
    for (const Light& light : make_lights(scene, 50, {})) EXPECT_GT(light.position.y, 0.0);
}

TEST(SurfaceLights, ChooseInstancesByTheirArea) {
    Scene scene = scene_with(Placement::surface);  // 2 x 2 at the origin, and 1 x 1 far away
    glm::dmat4 far(1.0);
    far[3] = glm::dvec4(100, 0, 0, 1);
    scene.instances.push_back({.mesh = 0, .transform = far});
    int on_small = 0;
    for (const Light& light : make_lights(scene, 4000, {})) on_small += light.position.x > 50.0 ? 1 : 0;
    EXPECT_NEAR(on_small / 4000.0, 0.2, 5.0 * std::sqrt(0.2 * 0.8 / 4000.0));
}

// How many lights reach a point, on average over random points of `where`.
double mean_reach(const std::vector<Light>& lights, const Bounds& where) {
    Random random(99);
    constexpr int kPoints = 4000;
    int64_t reached = 0;
    for (int i = 0; i < kPoints; ++i) {
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) p[k] = random.uniform(where.low[k], where.high[k]);
        for (const Light& light : lights) reached += glm::length(light.position - p) < light.radius ? 1 : 0;
    }
    return static_cast<double>(reached) / kPoints;
}

// Points are taken a radius away from the border of the bounds, where lights are missing on one side.
TEST(ConstantOverlap, HoldsInAVolume) {
    const Bounds bounds{{0, 0, 0}, {2, 4, 8}};
    for (const Placement placement : {Placement::grid, Placement::random}) {
        for (const double k : {4.0, 16.0}) {
            for (const int count : {1024, 4096}) {
                const auto lights = make_lights(scene_with(placement, bounds), count, {.overlap = k});
                const double r = lights[0].radius;
                ASSERT_LT(r, 1.0);
                EXPECT_NEAR(mean_reach(lights, {bounds.low + r, bounds.high - r}), k, 0.1 * k)
                    << count << " lights, k = " << k;
            }
        }
    }
}

TEST(ConstantOverlap, HoldsInAPlane) {
    const Bounds bounds{{0, 1, 0}, {4, 1, 8}};
    const auto lights = make_lights(scene_with(Placement::grid, bounds), 4096, {.overlap = 8.0});
    const double r = lights[0].radius;
    EXPECT_NEAR(mean_reach(lights, {{r, 1, r}, {4 - r, 1, 8 - r}}), 8.0, 0.5);
}

// With 300 lights all reach the surface; with 4000 the radius is within the range of heights and some do not.
TEST(ConstantOverlap, HoldsOnSurfacesWhateverTheHeight) {
    Scene scene = scene_with(Placement::surface);
    scene.lights.generator->height_min = 0.05;
    scene.lights.generator->height_max = 0.15;
    for (const int count : {300, 4000}) {
        const auto lights = make_lights(scene, count, {.overlap = 8.0});
        const double r = lights[0].radius;
        EXPECT_EQ(r > 0.15, count == 300);
        ASSERT_LT(r, 0.5);
        EXPECT_NEAR(mean_reach(lights, {{r, 0, r}, {2 - r, 0, 2 - r}}), 8.0, 1.0) << count;
    }
}

TEST(Lights, BadRequestsAreRefusedByName) {
    const Scene scene = scene_with(Placement::random);
    EXPECT_THAT(input_error([&] { make_lights(scene, -1, {}); }), HasSubstr("square: -1 lights"));
    EXPECT_THAT(input_error([&] { make_lights(scene, 1, {.overlap = -1.0}); }), HasSubstr("overlap of -1"));
    EXPECT_THAT(input_error([&] { make_lights(scene, 1, {.overlap = std::nan("")}); }), HasSubstr("overlap of"));
    EXPECT_THAT(input_error([&] { make_lights(scene, 1, {.overlap = std::numeric_limits<double>::infinity()}); }),
                HasSubstr("overlap of inf"));
    Scene written = square_scene();
    written.lights.fixed.resize(2);
    EXPECT_EQ(make_lights(written, 2, {.overlap = 8.0}).size(), 2U);
    EXPECT_THAT(input_error([&] { make_lights(written, 3, {}); }), HasSubstr("holds 2 and no generator"));
    Scene empty = scene_with(Placement::surface);
    empty.instances.clear();
    EXPECT_THAT(input_error([&] { make_lights(empty, 1, {}); }), HasSubstr("no surface has an area"));
}

}  // namespace
}  // namespace lightsweep
