// What the sum over lights must not depend on: their order, their number, threads, tiles, and lights that do not reach.
#include "tests/unit/reference/fixtures.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numeric>

namespace lightsweep {
namespace {

// Not multiples of the tiles' size.
constexpr int kWidth = 150;
constexpr int kHeight = 75;

Scene dim_scene() {
    Scene scene;
    scene.ambient = glm::dvec3(0.05);
    scene.background = {0.1, 0.2, 0.3};
    return scene;
}

std::vector<glm::dvec3> shade(std::span<const ReferenceSurface> surfaces, std::span<const Light> lights) {
    return shade_reference(dim_scene(), surfaces, kWidth, kHeight, kWavyCamera, lights);
}

// Of the light alone: relative to the pixel's radiance.
void expect_close(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, double relative) {
    ASSERT_EQ(a.size(), b.size());
    double worst = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(a[i][c] - b[i][c]) / std::max(a[i][c], 1e-3));
    EXPECT_LE(worst, relative);
}

TEST(Shading, OrderOfLightsIsWithinRounding) {
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    auto lights = many_lights(100);
    const auto forwards = shade(surfaces, lights);
    std::ranges::reverse(lights);
    const auto backwards = shade(surfaces, lights);
    EXPECT_NE(forwards, backwards) << "the order did not change";
    expect_close(forwards, backwards, 1e-13);
}

TEST(Shading, TwoHalvesOfALightAreTheLight) {
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    const auto lights = many_lights(40);
    std::vector<Light> halves;
    for (Light light : lights) {
        light.color *= 0.5;
        halves.insert(halves.end(), {light, light});
    }
    expect_close(shade(surfaces, lights), shade(surfaces, halves), 1e-13);
}

TEST(Shading, LightsAddUp) {
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    const auto lights = many_lights(60);
    const auto all = shade(surfaces, lights), none = shade(surfaces, {});
    const std::span some(lights);
    const auto first = shade(surfaces, some.first(20)), rest = shade(surfaces, some.subspan(20));
    std::vector<glm::dvec3> sum;
    for (size_t i = 0; i < all.size(); ++i) sum.push_back(first[i] + (rest[i] - none[i]));
    expect_close(all, sum, 1e-12);
}

TEST(Shading, IsTheSameForAnyNumberOfThreads) {
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    const auto lights = many_lights(100);
    const auto on_all = shade(surfaces, lights);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(shade(surfaces, lights), on_all);
}

TEST(Shading, SkippedLightsChangeNoBit) {
    // The same surfaces thrown about: then every tile's box is as large as the scene, and every light is evaluated
    // everywhere, in other lanes. Before, most are skipped.
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    std::vector<size_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), size_t{0});
    Random random(11);
    for (size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random.index(i + 1)]);
    std::vector<ReferenceSurface> thrown;
    for (const size_t i : order) thrown.push_back(surfaces[i]);

    const auto lights = many_lights(200);
    const auto sifted = shade(surfaces, lights), evaluated = shade(thrown, lights);
    for (size_t i = 0; i < order.size(); ++i) ASSERT_EQ(evaluated[i], sifted[order[i]]) << "pixel " << order[i];
}

TEST(Shading, PixelsDoNotKnowTheirNeighbours) {
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    const auto lights = many_lights(100);
    const auto together = shade(surfaces, lights);
    for (size_t i = 0; i < surfaces.size(); i += 97) {
        const auto alone = shade_reference(dim_scene(), std::span(&surfaces[i], 1), 1, 1, kWavyCamera, lights);
        EXPECT_EQ(alone.front(), together[i]) << "pixel " << i;
    }
}

TEST(Shading, LightsAreRelativeToTheEye) {
    const auto surfaces = wavy_surfaces(kWidth, kHeight);
    auto lights = many_lights(100);
    const auto near_origin = shade(surfaces, lights);
    const glm::dvec3 shift(0x1p20, -0x1p21, 0x1p19);
    for (Light& light : lights) light.position += shift;
    Camera camera = kWavyCamera;
    camera.eye += shift;
    const auto far_away = shade_reference(dim_scene(), surfaces, kWidth, kHeight, camera, lights);
    expect_close(near_origin, far_away, 1e-5);  // positions of lights keep 33 of their 53 bits
}

}  // namespace
}  // namespace lightsweep
