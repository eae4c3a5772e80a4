// What is hidden behind what a picture shows: never anything that a pixel could show, and most of the rest.
#include "renderer/frame/occlusion.h"
#include "tests/unit/frame/lights.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightsweep {
namespace {

constexpr float kNothing = 1e30F;

float farthest_of(const std::vector<float>& tiles, int tiles_x, int x0, int y0, int x1, int y1) {
    float result = 0.0F;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) result = std::max(result, tiles[static_cast<size_t>(y * tiles_x + x)]);
    }
    return result;
}

TEST(DepthPyramid, SaysTheFarthestOfARangeOrOfALittleMore) {
    size_t exact = 0, asked = 0;
    for (uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const int w = 1 + static_cast<int>(random.index(70)), h = 1 + static_cast<int>(random.index(40));
        std::vector<float> tiles;
        for (int i = 0; i < w * h; ++i) tiles.push_back(static_cast<float>(random.uniform(1.0, 100.0)));
        DepthPyramid pyramid;
        pyramid.build(tiles, w, h);
        for (int k = 0; k < 100; ++k) {
            const auto range = [&](int size) {
                const auto a = static_cast<int>(random.index(static_cast<uint64_t>(size)));
                const auto b = static_cast<int>(random.index(static_cast<uint64_t>(size)));
                return std::pair(std::min(a, b), std::max(a, b) + 1);
            };
            const auto [x0, x1] = range(w);
            const auto [y0, y1] = range(h);
            const float said = pyramid.farthest(x0, y0, x1, y1);
            const float least = farthest_of(tiles, w, x0, y0, x1, y1);
            // Squares of the level are shorter than twice the range's longer side, and it touches both at the ends.
            const int more = 2 * std::max(x1 - x0, y1 - y0);
            const float most = farthest_of(tiles, w, std::max(x0 - more, 0), std::max(y0 - more, 0),
                                           std::min(x1 + more, w), std::min(y1 + more, h));
            EXPECT_GE(said, least) << w << " x " << h << ": [" << x0 << ", " << x1 << ") x [" << y0 << ", " << y1;
            EXPECT_LE(said, most);
            ++asked;
            exact += said == least ? 1 : 0;
        }
        EXPECT_EQ(pyramid.farthest(0, 0, w, h), *std::ranges::max_element(tiles));
        for (int i = 0; i < w * h; ++i) {
            EXPECT_EQ(pyramid.farthest(i % w, i / w, i % w + 1, i / w + 1), tiles[static_cast<size_t>(i)]);
        }
    }
    EXPECT_GT(exact, asked / 4);
}

TEST(DepthPyramid, IsBuiltAnewForAnotherSize) {
    DepthPyramid pyramid;
    pyramid.build(std::vector<float>(40 * 30, 9.0F), 40, 30);
    pyramid.build(std::vector<float>{1.0F, 2.0F, 3.0F}, 3, 1);
    EXPECT_EQ(pyramid.farthest(0, 0, 3, 1), 3.0F);
    EXPECT_EQ(pyramid.farthest(0, 0, 2, 1), 2.0F);
}

// A picture of rectangles at any distance in front of nothing.
struct Picture {
    Picture(const TestView& view, int tile, Random& random)
        : width(view.setup.width), height(view.setup.height), tile_px(tile) {
        const Camera& camera = view.setup.camera;
        const double far = std::min(camera.far_distance, 1e4 * camera.near_distance);
        depths.assign(static_cast<size_t>(width * height), kNothing);
        const bool wall = random.index(2) == 0;
        for (int i = 0; i < 12; ++i) {
            const auto z = static_cast<float>(log_uniform(random, camera.near_distance, far));
            const auto at = [&](int size) { return static_cast<int>(random.index(static_cast<uint64_t>(size))); };
            const int x0 = at(width), y0 = at(height), x1 = x0 + at(width) + 1, y1 = y0 + at(height) + 1;
            const bool all = wall && i == 0;
            for (int y = all ? 0 : y0; y < (all ? height : std::min(y1, height)); ++y) {
                for (int x = all ? 0 : x0; x < (all ? width : std::min(x1, width)); ++x) {
                    float& depth = depths[static_cast<size_t>(y * width + x)];
                    depth = std::min(depth, z);
                }
            }
        }
        tiles_x = (width + tile - 1) / tile;
        tiles_y = (height + tile - 1) / tile;
        for (int y = 0; y < tiles_y; ++y) {
            for (int x = 0; x < tiles_x; ++x) {
                tiles.push_back(farthest_of(depths, width, x * tile, y * tile, std::min((x + 1) * tile, width),
                                            std::min((y + 1) * tile, height)));
            }
        }
    }
    int width, height, tile_px, tiles_x, tiles_y;
    std::vector<float> depths, tiles;
};

// The view distance at which a pixel's ray enters a sphere of view space; negative when it misses it.
double enters(const glm::dvec3& ray, const glm::vec4& sphere) {
    const glm::dvec3 center(sphere), direction = glm::normalize(ray);
    const double along = glm::dot(center, direction), r = sphere.w;
    const double apart = glm::dot(center, center) - along * along;
    if (apart > r * r) return -1.0;
    return (along - std::sqrt(r * r - apart)) * direction.z;
}

struct Statistics {
    int hidden = 0, could_be = 0;
};

// Against every pixel's ray, and how many of those are found that the tiles' own depths hide.
Statistics check_spheres(const FrameSetup& setup, Random& random) {
    const TestView view(setup);
    constexpr int kTilePx[] = {1, 4, 16};  // single pixels hide no mistake
    const Picture picture(view, kTilePx[random.index(3)], random);
    DepthPyramid pyramid;
    pyramid.build(picture.tiles, picture.tiles_x, picture.tiles_y);
    const double near = setup.camera.near_distance, far = std::min(setup.camera.far_distance, 1e4 * near);
    std::vector<glm::vec4> spheres;
    for (int i = 0; i < 60; ++i) {
        const double z = log_uniform(random, 0.5 * near, 3.0 * far);
        glm::dvec3 place(random.uniform(-1.2, 1.2) * view.tan_x * z, random.uniform(-1.2, 1.2) * view.tan_y * z, z);
        if (random.index(10) == 0) place = random_direction(random) * z;
        spheres.emplace_back(glm::vec3(place), static_cast<float>(glm::length(place) * log_uniform(random, 1e-3, 1.5)));
    }
    std::vector<uint8_t> hidden(spheres.size(), 2);
    find_hidden_spheres(spheres, setup, pyramid, picture.tile_px, hidden);

    Statistics statistics;
    for (size_t i = 0; i < spheres.size(); ++i) {
        const bool touches_near = spheres[i].z - spheres[i].w <= static_cast<float>(near);
        bool seen = false;
        float behind = 0.0F;  // the farthest of the tiles whose pixels see it
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const double z = enters(view.ray(x, y), spheres[i]);
                if (z < 0.0) continue;
                seen = seen || z <= picture.depths[static_cast<size_t>(y * picture.width + x)];
                behind = std::max(
                    behind,
                    picture.tiles[static_cast<size_t>(y / picture.tile_px * picture.tiles_x + x / picture.tile_px)]);
            }
        }
        EXPECT_LE(hidden[i], 1);
        EXPECT_FALSE(hidden[i] == 1 && (touches_near || seen))
            << "sphere " << i << " at " << spheres[i].x << ", " << spheres[i].y << ", " << spheres[i].z << ", radius "
            << spheres[i].w;
        const bool could_be = behind > 0.0F && !touches_near && spheres[i].z - spheres[i].w > 1.01F * behind;
        statistics.could_be += could_be ? 1 : 0;
        statistics.hidden += could_be && hidden[i] == 1 ? 1 : 0;
    }
    return statistics;
}

TEST(FindHiddenSpheres, NeverHidesWhatAPixelShowsAndMissesFew) {
    Statistics all;
    for (uint64_t seed = 0; seed < 250; ++seed) {
        Random random(seed);
        FrameSetup setup = random_setup(random);
        setup.width = 1 + static_cast<int>(random.index(130));
        setup.height = 1 + static_cast<int>(random.index(90));
        if (seed % 3 == 0) setup.convention = DepthConvention::standard;
        const Statistics some = check_spheres(setup, random);
        all.hidden += some.hidden;
        all.could_be += some.could_be;
        if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
    }
    EXPECT_GT(all.could_be, 1000);
    EXPECT_GT(all.hidden, all.could_be * 8 / 10);
}

// A wall of single-pixel tiles with one hole: through the outermost pixels of a sphere it is seen, a little further out
// it is not.
TEST(FindHiddenSpheres, KnowsASpheresOutermostPixels) {
    int tested = 0;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        FrameSetup setup = plain_setup(61, 43);
        setup.camera.fov_y_deg = random.uniform(20.0, 120.0);
        const TestView view(setup);
        const double z = log_uniform(random, 1.0, 50.0);
        const glm::dvec3 place(random.uniform(-1.0, 1.0) * view.tan_x * z, random.uniform(-1.0, 1.0) * view.tan_y * z,
                               z);
        const glm::vec4 sphere(glm::vec3(place), static_cast<float>((z - 0.2) * log_uniform(random, 0.05, 0.9)));
        struct Pixel {
            int x, y;
        };
        std::vector<Pixel> seen;
        for (int y = 0; y < setup.height; ++y) {
            for (int x = 0; x < setup.width; ++x) {
                if (enters(view.ray(x, y), sphere) > 0.0) seen.push_back({x, y});
            }
        }
        if (seen.empty()) continue;
        const auto hidden_but_for = [&](Pixel hole) {
            std::vector<float> tiles(static_cast<size_t>(setup.width * setup.height), 0.9F * (sphere.z - sphere.w));
            tiles[static_cast<size_t>(hole.y * setup.width + hole.x)] = kNothing;
            DepthPyramid pyramid;
            pyramid.build(tiles, setup.width, setup.height);
            uint8_t hidden = 2;
            find_hidden_spheres(std::span(&sphere, 1), setup, pyramid, 1, std::span(&hidden, 1));
            return hidden == 1;
        };
        const auto [left, right] = std::ranges::minmax_element(seen, {}, &Pixel::x);
        const auto [bottom, top] = std::ranges::minmax_element(seen, {}, &Pixel::y);
        for (const Pixel& pixel : {*left, *right, *bottom, *top}) {
            EXPECT_FALSE(hidden_but_for(pixel)) << "seed " << seed << ": " << pixel.x << ", " << pixel.y;
        }
        // The level that is looked at has squares of up to the range's length.
        const int reach = 2 * std::max(right->x - left->x, top->y - bottom->y) + 4;
        for (const Pixel& pixel : {Pixel{left->x - reach, left->y}, Pixel{right->x + reach, right->y},
                                   Pixel{bottom->x, bottom->y - reach}, Pixel{top->x, top->y + reach}}) {
            if (pixel.x < 0 || pixel.x >= setup.width || pixel.y < 0 || pixel.y >= setup.height) continue;
            EXPECT_TRUE(hidden_but_for(pixel)) << "seed " << seed << ": " << pixel.x << ", " << pixel.y;
            ++tested;
        }
    }
    EXPECT_GT(tested, 50);
}

// 90 degrees, 256 x 256 px, tiles of 16: the slope s is at the tile 8 + 8 s, both ways.
class FindHiddenInAWall : public testing::Test {
  protected:
    static constexpr int kTiles = 16;

    bool is_hidden(const glm::vec4& sphere) const {
        DepthPyramid pyramid;
        pyramid.build(tiles_, kTiles, kTiles);
        uint8_t hidden = 2;
        find_hidden_spheres(std::span(&sphere, 1), setup_, pyramid, 16, std::span(&hidden, 1));
        return hidden == 1;
    }
    float& tile(int x, int y) { return tiles_[static_cast<size_t>(y * kTiles + x)]; }

    FrameSetup setup_{.camera = {.fov_y_deg = 90.0, .near_distance = 0.5}, .width = 256, .height = 256};
    std::vector<float> tiles_ = std::vector<float>(kTiles * kTiles, 8.0F);
};

TEST_F(FindHiddenInAWall, WhatBeginsBehindIt) {
    EXPECT_TRUE(is_hidden({0.0F, 0.0F, 10.0F, 1.0F}));
    EXPECT_FALSE(is_hidden({0.0F, 0.0F, 10.0F, 2.5F})) << "begins before it";
    EXPECT_FALSE(is_hidden({0.0F, 0.0F, 9.0F, 1.0F})) << "touches it";
    EXPECT_TRUE(is_hidden({0.0F, 0.0F, 9.001F, 1.0F}));
}

// Around the slope 0.3 with a radius of 0.05 of the distance: columns 10.0 to 10.8, rows 5.1 to 6.1 for -0.3.
TEST_F(FindHiddenInAWall, ATileWithoutSurfaceShowsWhatLiesInIt) {
    const glm::vec4 sphere{6.0F, -6.0F, 20.0F, 0.6F};
    EXPECT_TRUE(is_hidden(sphere));
    tile(10, 5) = kNothing;
    EXPECT_FALSE(is_hidden(sphere));
    tile(10, 5) = 8.0F;
    tile(5, 10) = kNothing;
    EXPECT_TRUE(is_hidden(sphere)) << "x and y are not to be mixed up";
    tile(10, 10) = kNothing;
    EXPECT_TRUE(is_hidden(sphere)) << "y grows upwards";
    tile(10, 5) = 19.0F;
    EXPECT_TRUE(is_hidden(sphere));
    tile(10, 5) = 19.5F;
    EXPECT_FALSE(is_hidden(sphere));
}

TEST_F(FindHiddenInAWall, NothingThatTouchesTheNearSide) {
    std::ranges::fill(tiles_, 0.1F);
    EXPECT_FALSE(is_hidden({0.0F, 0.0F, 0.0F, 1.0F})) << "around the eye";
    EXPECT_FALSE(is_hidden({0.0F, 0.0F, 5.0F, 4.75F})) << "through the near plane";
    EXPECT_FALSE(is_hidden({0.0F, 0.0F, 5.0F, 4.5F})) << "touches the near plane";
    EXPECT_TRUE(is_hidden({0.0F, 0.0F, 5.0F, 4.4F}));
    EXPECT_FALSE(is_hidden({0.0F, 0.0F, -5.0F, 1.0F})) << "behind the eye";
    EXPECT_FALSE(is_hidden({9.0F, 0.0F, 0.4F, 1.0F})) << "beside the eye";
}

TEST_F(FindHiddenInAWall, WhatIsNoNumberMayBeAnywhere) {
    EXPECT_TRUE(is_hidden({0.0F, 0.0F, 20.0F, 1.0F}));
    tile(15, 15) = kNothing;
    EXPECT_TRUE(is_hidden({0.0F, 0.0F, 20.0F, 1.0F}));
    for (int i = 0; i < 4; ++i) {
        glm::vec4 sphere{0.0F, 0.0F, 20.0F, 1.0F};
        sphere[i] = std::nanf("");
        EXPECT_FALSE(is_hidden(sphere)) << i;
    }
}

}  // namespace
}  // namespace lightsweep
