#include "renderer/scene/texture_gen.h"

#include <gtest/gtest.h>

#include <set>

namespace lightsweep {
namespace {

std::array<int, 4> texel(const Texture& t, int x, int y) {
    const size_t at = 4 * (static_cast<size_t>(y) * static_cast<size_t>(t.width) + static_cast<size_t>(x));
    return {t.rgba[at], t.rgba[at + 1], t.rgba[at + 2], t.rgba[at + 3]};
}

constexpr ColorPair kWhiteAndGrey{glm::dvec3(1.0), glm::dvec3(0.2)};

TEST(Checker, AlternatesInBothDirections) {
    const Texture t = make_checker({.size = 8}, 4, kWhiteAndGrey);
    EXPECT_EQ(t.rgba.size(), 8U * 8U * 4U);
    EXPECT_EQ(texel(t, 0, 0), (std::array{255, 255, 255, 255}));
    EXPECT_EQ(texel(t, 1, 1), texel(t, 0, 0));
    EXPECT_EQ(texel(t, 2, 0), (std::array{51, 51, 51, 255}));
    EXPECT_EQ(texel(t, 0, 2), texel(t, 2, 0));
    EXPECT_EQ(texel(t, 2, 2), texel(t, 0, 0));
}

// IEC 61966-2-1: linear 0.2 is 0.4845 encoded, which is 124 of 255.
TEST(Checker, ColoursAreEncodedWhenTheTextureIsSrgb) {
    EXPECT_EQ(texel(make_checker({.size = 8, .srgb = true}, 4, kWhiteAndGrey), 2, 0), (std::array{124, 124, 124, 255}));
}

TEST(Noise, IsDeterministicSeededAndWithinItsColours) {
    const ColorPair colors{glm::dvec3(0.2), glm::dvec3(0.8)};
    const Texture a = make_noise({.size = 64}, 4, 3, 1, colors);
    EXPECT_EQ(a.rgba, make_noise({.size = 64}, 4, 3, 1, colors).rgba);
    EXPECT_NE(a.rgba, make_noise({.size = 64}, 4, 3, 2, colors).rgba);
    std::set<int> values;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) values.insert(texel(a, x, y)[0]);
    }
    EXPECT_GE(*values.begin(), 51);
    EXPECT_LE(*values.rbegin(), 204);
    EXPECT_GT(values.size(), 30U) << "it varies";
}

// Neighbours across the border differ no more than neighbours elsewhere.
TEST(Noise, Tiles) {
    const Texture t = make_noise({.size = 128}, 4, 1, 5, {glm::dvec3(0.0), glm::dvec3(1.0)});
    int inside = 0;
    int border = 0;
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x + 1 < 128; ++x)
            inside = std::max(inside, std::abs(texel(t, x, y)[0] - texel(t, x + 1, y)[0]));
        border = std::max(border, std::abs(texel(t, 127, y)[0] - texel(t, 0, y)[0]));
    }
    EXPECT_LE(border, inside);
}

// A cell holds a disc: pi r^2 of its area is cut out.
TEST(Holes, CutOutTheirArea) {
    const Texture t = make_holes({.size = 512}, 4, 0.4, glm::dvec3(1.0));
    int open = 0;
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) open += texel(t, x, y)[3] == 0 ? 1 : 0;
    }
    EXPECT_NEAR(open / (512.0 * 512.0), 3.14159265 * 0.4 * 0.4, 0.01);
}

// On the way up a bump, from its left, the normal leans left; from above it in the image, it leans up (+Y).
TEST(Bumps, NormalsLeanAwayFromTheSummit) {
    const Texture t = make_bumps(64, 1, 0.5);  // sin(2 pi u) sin(2 pi v): a summit at a quarter of each
    EXPECT_LT(texel(t, 8, 16)[0], 100);
    EXPECT_GT(texel(t, 24, 16)[0], 155);
    EXPECT_GT(texel(t, 16, 8)[1], 155);
    EXPECT_LT(texel(t, 16, 24)[1], 100);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto [r, g, b, a] = texel(t, x, y);
            const glm::dvec3 normal = glm::dvec3(r, g, b) / 127.5 - 1.0;
            ASSERT_NEAR(glm::length(normal), 1.0, 0.015);
        }
    }
}

TEST(Bumps, AreFlatWithoutHeight) { EXPECT_EQ(texel(make_bumps(8, 2, 0.0), 3, 5), (std::array{128, 128, 255, 255})); }

}  // namespace
}  // namespace lightsweep
