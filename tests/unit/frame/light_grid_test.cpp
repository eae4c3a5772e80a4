// The grid: every pixel and view distance has one cell, and the slices cover what the lights reach.
#include "tests/unit/frame/lights.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

using shared::LightBounds;
using shared::LightGridData;

LightBounds sphere(float x, float y, float z, float radius) {
    return {{x, y, z}, radius, {x, y, z}, radius, {0.0F, 0.0F, 1.0F}, -1.0F};
}

TEST(LightGrid, TilesCoverThePictureAndNoMore) {
    const auto grid = make_light_grid({.tile_px = 16}, plain_setup(1280, 721), {});
    EXPECT_EQ(grid.tiles_x, 80U);
    EXPECT_EQ(grid.tiles_y, 46U) << "721 = 45 * 16 + 1";
    EXPECT_EQ(grid.slices, 1U);
    const auto one = make_light_grid({.tile_px = 16, .slices = true}, plain_setup(1, 1), {});
    EXPECT_EQ(cell_count(one), 1U);
}

TEST(LightGrid, SlopesOfItsEdgesAreThoseOfThePicture) {
    FrameSetup setup = plain_setup(200, 100);
    setup.camera.fov_y_deg = 90.0;  // the top edge has the slope 1, the right one 2
    const auto grid = make_light_grid({.tile_px = 50}, setup, {});
    const auto cell = shared::cell_bounds(grid, 3, 1, 0.0F, 1.0F);
    EXPECT_NEAR(cell.slopes.x, 1.0, 1e-6);
    EXPECT_NEAR(cell.slopes.y, 0.0, 1e-6);
    EXPECT_NEAR(cell.slopes.z, 2.0, 1e-6);
    EXPECT_NEAR(cell.slopes.w, 1.0, 1e-6);
}

TEST(LightGrid, WithoutSlicesEveryDistanceIsInTheOnlyOne) {
    const LightBounds light = sphere(0.0F, 0.0F, 5.0F, 1.0F);
    for (const bool slices : {false, true}) {
        const auto grid = make_light_grid({.tile_px = 16, .slices = slices}, plain_setup(),
                                          slices ? std::span<const LightBounds>() : std::span(&light, 1));
        EXPECT_EQ(grid.slices, 1U);
        for (const float z : {0.0F, 1e-3F, 1.0F, 1e6F}) EXPECT_EQ(shared::slice_of(grid, z), 0U) << z;
        EXPECT_GT(shared::slice_begin(grid, 1), 5.9999F);
    }
}

TEST(LightGrid, SlicesFollowOneAnotherAndReachAsFarAsTheLights) {
    for (uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const FrameSetup setup = random_setup(random);
        const double near = setup.camera.near_distance, far = setup.camera.far_distance;
        std::vector<LightBounds> lights;
        for (int i = 0; i < 5; ++i) {
            const auto z = static_cast<float>(log_uniform(random, near, far));
            lights.push_back(sphere(0.0F, 0.0F, z, z * static_cast<float>(log_uniform(random, 1e-3, 2.0))));
        }
        const auto grid = make_light_grid({.tile_px = 8, .slices = true}, setup, lights);
        ASSERT_GE(grid.slices, 1U);
        EXPECT_LE(cell_count(grid), 131'072U);
        EXPECT_EQ(shared::slice_begin(grid, 0), 0.0F);
        for (uint32_t s = 0; s < grid.slices; ++s) {
            const float low = shared::slice_begin(grid, s), high = shared::slice_begin(grid, s + 1);
            ASSERT_GT(high, low);
            for (const float share : {0.01F, 0.5F, 0.99F}) {
                EXPECT_EQ(shared::slice_of(grid, low + share * (high - low)), s) << "seed " << seed;
            }
        }
        double highest = 0.0;
        for (const LightBounds& light : lights) highest = std::max(highest, double{light.center.z} + light.radius);
        EXPECT_GE(shared::slice_begin(grid, grid.slices) * (1.0 + 1e-5), std::min(highest, far)) << "seed " << seed;
    }
}

TEST(LightGrid, SlicesAreAboutAsDeepAsTilesAreWide) {
    const LightBounds lights[] = {sphere(0.0F, 0.0F, 4.0F, 1.0F), sphere(0.0F, 0.0F, 20.0F, 1.0F)};
    const FrameSetup setup = plain_setup(1280, 720);
    const auto grid = make_light_grid({.tile_px = 32, .slices = true}, setup, lights);
    const double low = shared::slice_begin(grid, grid.slices / 2),
                 high = shared::slice_begin(grid, grid.slices / 2 + 1);
    const double width = 32 * grid.tangent_per_px_x * low;
    EXPECT_GT((high - low) / width, 0.7);
    EXPECT_LT((high - low) / width, 1.4);
    EXPECT_NEAR(shared::slice_begin(grid, 1), 3.0, 1e-3) << "nothing is reached before";
    EXPECT_NEAR(shared::slice_begin(grid, grid.slices), 21.0, 1e-3);
}

TEST(LightGrid, LargePicturesGetFewerSlices) {
    const LightBounds light = sphere(0.0F, 0.0F, 10.0F, 9.9F);
    for (const auto& [width, height] : {std::pair(3840, 2160), {7680, 4320}, {16384, 16384}}) {
        const auto grid = make_light_grid({.tile_px = 8, .slices = true}, plain_setup(width, height), {&light, 1});
        const size_t tiles = size_t{grid.tiles_x} * grid.tiles_y;
        EXPECT_LE(cell_count(grid), std::max<size_t>(tiles, 131'072)) << width;
    }
}

}  // namespace
}  // namespace lightsweep
