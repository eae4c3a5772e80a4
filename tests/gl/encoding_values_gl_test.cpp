// What must hold for single values through the encodings: axes, folds, poles and ends come back exactly, or as near as
// the format's steps allow; what cannot be carried comes back as what is nearest.
#include "tests/gl/round_trips.h"

#include "renderer/base/random.h"
#include "renderer/frame/frame.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

TEST(EncodedValues, AxesFoldAndCornersOfTheOctahedronAreExact) {
    const float h = std::sqrt(0.5F);
    const std::vector<glm::vec4> exact = {
        {1, 0, 0, 0},          {-1, 0, 0, 0},        {0, 1, 0, 0},      {0, -1, 0, 0},
        {0, 0, 1, 0},          {0, 0, -1, 0},  // all four corners of the square are this one
        {-0.0F, -0.0F, -1, 0}, {1, -0.0F, -0.0F, 0}, {-1, 0, -0.0F, 0}, {-0.0F, 1, -0.0F, 0}};
    const std::vector<glm::vec4> fold = {{h, h, 0, 0}, {-h, h, 0, 0}, {h, -h, -0.0F, 0}, {-h, -h, 0, 0}};
    for (const char* encoding : {"oct", "oct_precise"}) {
        for (const char* bits : {"_8_8", "_10_10", "_12_12", "_16_16"}) {
            const Variant& v = variant("normal", std::string(encoding) + bits);
            const auto back = back_of(v, exact);
            for (size_t i = 0; i < exact.size(); ++i) {
                EXPECT_EQ(back[i], glm::dvec3(exact[i])) << v.name << " of axis " << i;
            }
            // The fold's middles lie half-way between steps (127 / 2): off by no more than half a step there, which
            // turns (x, y, 1 - |x| - |y|) by at most sqrt(1 + 1 + 4) / 2 steps over a length of sqrt(1/2).
            const double step = channel_grid(v.layout.targets.front().format, v.stored(), 0)->step;
            const auto near_fold = back_of(v, fold);
            for (size_t i = 0; i < fold.size(); ++i) {
                EXPECT_LE(glm::radians(angle_deg(glm::dvec3(fold[i]), near_fold[i])), std::sqrt(3.0) * step) << v.name;
            }
        }
    }
}

TEST(EncodedValues, AxesOfComponentsAreExactWhereZeroIs) {
    const std::vector<glm::vec4> axes = {{1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0},         {0, -1, 0, 0},
                                         {0, 0, 1, 0}, {0, 0, -1, 0}, {-0.0F, -0.0F, -1, 0}};
    for (const char* name : {"float_32_32_32", "half_16_16_16", "snorm_8_8_8", "best_fit_8_8_8"}) {
        const auto back = back_of(variant("normal", name), axes);
        for (size_t i = 0; i < axes.size(); ++i) EXPECT_EQ(back[i], glm::dvec3(axes[i])) << name << " of axis " << i;
    }
    // Unsigned formats have no zero: off by half a step in two channels.
    for (const auto& [name, step] : {std::pair{"unorm_8_8_8", 2.0 / 255.0}, {"unorm_10_10_10", 2.0 / 1023.0}}) {
        const auto back = back_of(variant("normal", name), axes);
        for (size_t i = 0; i < axes.size(); ++i) {
            EXPECT_NEAR(glm::radians(angle_deg(glm::dvec3(axes[i]), back[i])), std::sqrt(0.5) * step, 0.02 * step)
                << name;
        }
    }
}

TEST(EncodedValues, PolesOfTheSpheremapAreExact) {
    for (const char* name : {"spheremap_8_8", "spheremap_10_10", "spheremap_12_12", "spheremap_16_16"}) {
        const auto back = back_of(variant("normal", name), {{0, 0, 1, 0}, {0, 0, -1, 0}, {-0.0F, -0.0F, -1, 0}});
        EXPECT_EQ(back[0], glm::dvec3(0, 0, 1)) << name;
        EXPECT_EQ(back[1], glm::dvec3(0, 0, -1)) << name;
        EXPECT_EQ(back[2], glm::dvec3(0, 0, -1)) << name;
    }
}

TEST(EncodedValues, HemispheresAreAboutThePixelsRay) {
    const Camera camera = probe_camera(variant("normal", "hemi_oct_16_16"));
    const glm::dmat4 world = glm::inverse(camera_projection(camera, 8, 8, DepthConvention::reversed));
    for (const char* name : {"hemi_oct_16_16", "xy_z_16_16"}) {
        // Turned about each pixel's ray. Flat ground that the eye sees at 2 degrees comes back, in a corner of the
        // picture as in its middle; what looks away by 10 is turned to the nearest that can be stored, on the
        // silhouette; and what looks straight away comes back as anything, but a normal.
        std::vector<glm::vec4> grazing, away, straight;
        for (int i = 0; i < 64; ++i) {
            const glm::dvec4 place = world * glm::dvec4((i % 8 + 0.5) / 4.0 - 1.0, (i / 8 + 0.5) / 4.0 - 1.0, 0.5, 1.0);
            const glm::dvec3 ray = glm::normalize(glm::dvec3(place) / place.w);
            const glm::dvec3 side = glm::normalize(glm::cross(ray, glm::dvec3(std::cos(i), std::sin(i), 0.3)));
            const auto turned = [&](double degrees) {
                return glm::vec4(std::cos(glm::radians(degrees)) * side + std::sin(glm::radians(degrees)) * ray, 0.0);
            };
            grazing.push_back(turned(-2.0));
            away.push_back(turned(10.0));
            straight.emplace_back(ray, 0.0);
        }
        const auto grazing_back = back_of(variant("normal", name), grazing);
        const auto away_back = back_of(variant("normal", name), away);
        const auto straight_back = back_of(variant("normal", name), straight);
        for (size_t i = 0; i < 64; ++i) {
            EXPECT_LT(angle_deg(glm::dvec3(grazing[i]), grazing_back[i]), 0.1) << name << " in pixel " << i;
            EXPECT_NEAR(angle_deg(glm::dvec3(away[i]), away_back[i]), 10.0, 0.6) << name << " in pixel " << i;
            EXPECT_NEAR(glm::length(straight_back[i]), 1.0, 1e-6) << name << " in pixel " << i;
        }
    }
}

TEST(EncodedValues, BestFitTriesTheLongest) {
    // (n, n - 1, n - 2) with n the channel's largest value: no shorter vector of integers has this direction.
    for (const int bits : {4, 5, 6, 7, 8, 9, 10}) {
        Variant v = variant("normal", "best_fit_8_8_8");
        v.layout.targets.front().format = gl::Format::R32UI;
        auto& slots = v.layout.targets.front().fields.front().slots;
        for (int i = 0; i < 3; ++i) slots[static_cast<size_t>(i)] = {.low_bit = i * bits, .bit_count = bits};
        const double n = std::ldexp(1.0, bits - 1) - 1.0;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(n, n - 1.0, n - 2.0));
        EXPECT_LT(angle_deg(direction, back_of(v, {glm::vec4(direction, 0.0)})[0]), 1e-5) << bits << " bits";
    }
}

TEST(EncodedValues, ColorsKeepTheirEnds) {
    const std::vector<glm::vec4> ends = {{0, 0, 0, 0}, {1, 1, 1, 0}, {1, 0, 0, 0},
                                         {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 1, 0, 0}};
    for (const char* name : {"rgb_8_8_8", "rgb_10_10_10", "gamma2_8_8_8", "gamma2_7_7_7", "rgb9e5", "float_11_11_10"}) {
        const auto back = back_of(variant("base_color", name), ends);
        for (size_t i = 0; i < ends.size(); ++i) EXPECT_EQ(back[i], glm::dvec3(ends[i])) << name << " of colour " << i;
    }
    const auto srgb = back_of(variant("base_color", "srgb_8_8_8"), ends);
    for (size_t i = 0; i < ends.size(); ++i) EXPECT_LT(glm::length(srgb[i] - glm::dvec3(ends[i])), 1e-6);
    for (const char* name : {"linear_8", "sqrt_8", "log2_8", "linear_6", "sqrt_6", "log2_6"}) {
        const auto back = back_of(variant("roughness", name), {{0, 0, 0, 0}, {1, 0, 0, 0}});
        EXPECT_EQ(back[0].x, 0.0) << name;
        EXPECT_NEAR(back[1].x, 1.0, 1e-6) << name;
    }
}

TEST(EncodedValues, YcocgIsLuma8AndChroma8OnFlatGround) {
    // Constant colour: both chromas are at hand, so each root is off by at most s/2 of luma and, for red and blue, s/4
    // of both chromas (half of them is stored; green needs one): (s_y + s_c) / 2 of the root.
    const Variant& v = variant("base_color", "ycocg_8_8");
    const double s_y = 1.0 / 255.0, s_c = 1.0 / 127.0;
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 c(random.uniform(), random.uniform(), random.uniform());
        for (const auto& back : back_of(v, std::vector<glm::vec4>(64, glm::vec4(c, 0.0)))) {
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(std::sqrt(back[channel]), std::sqrt(c[channel]), (s_y + s_c) / 2.0 + 1e-5);
            }
        }
    }
}

TEST(EncodedValues, YcocgDoesNotBleedOverALumaEdge) {
    // A dark red and a bright green half: at the edge each keeps its own chroma.
    const glm::vec4 dark(0.2F, 0.01F, 0.01F, 0.0F), bright(0.3F, 0.9F, 0.2F, 0.0F);
    std::vector<glm::vec4> picture;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) picture.push_back(x < 7 ? dark : bright);
    }
    const auto back = round_trip(variant("base_color", "ycocg_8_8"), picture, 16, 16);
    for (size_t i = 0; i < back.size(); ++i) {
        EXPECT_LT(glm::length(glm::dvec3(back[i] - picture[i])), 0.03) << i % 16 << " " << i / 16;
    }
}

TEST(EncodedValues, SharedExponentsHoldTheirMantissa) {
    // Half a step of N mantissa bits, of the largest channel: at most 2^-N of it.
    EXPECT_LE(errors("emissive", "rgb9e5").max, 0x1p-9 * 1.001);
    EXPECT_GT(errors("emissive", "rgb9e5").max, 0x1p-10);
    // 1/16 is above the smallest exponent's range, so the bound holds down to there.
    EXPECT_LE(errors("emissive", "rgb4e3").max, 0x1p-3);
    const auto back =
        back_of(variant("emissive", "rgb4e3"), {{0, 0, 0, 0}, {30, 15, 0, 0}, {1e6F, 0, 0, 0}, {1, 0.5F, 0.25F, 0}});
    EXPECT_EQ(back[0], glm::dvec3(0));
    EXPECT_EQ(back[1], glm::dvec3(30, 16, 0)) << "15 is half-way between 14 and 16, and goes up";
    EXPECT_EQ(back[2], glm::dvec3(30, 0, 0)) << "clamped";
    EXPECT_EQ(back[3], glm::dvec3(1, 0.5, 0.25));
}

}  // namespace
}  // namespace lightsweep
