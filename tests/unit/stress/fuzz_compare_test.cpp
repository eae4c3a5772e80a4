// What must hold when a picture is held against its bounds: rounding passes, more fails, and what a format cannot hold
// is told apart from both.
#include "bench/stress/fuzz_compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// One pixel of the exact grey `right` that became the grey `shown`.
PictureFaults of_pixel(double right, float shown, const std::string& hdr = "rgba32f", int roundings = 1,
                       double movement = 0.0, bool judged = true, bool may_saturate = false) {
    Image image(1, 1, ColorSpace::linear);
    image.rgb.assign(3, shown);
    const BoundedRadiance exact{.radiance = {glm::dvec3(right)}, .movement = {movement}};
    return find_faults(image, exact, {judged}, {may_saturate}, hdr_rounding(hdr), roundings);
}

TEST(FindFaults, BoundsArithmeticAndMovement) {
    EXPECT_EQ(of_pixel(2.0, 2.0001F).wrong, 0U);
    EXPECT_EQ(of_pixel(2.0, 2.0003F).wrong, 1U);
    EXPECT_EQ(of_pixel(2.0, 2.0003F, "rgba32f", 1, 1e-4).wrong, 0U) << "twice the movement on top";
    EXPECT_EQ(of_pixel(2.0, 1.9997F).wrong, 1U);
}

TEST(FindFaults, BoundsTheRoundingOfTheFormat) {
    // A step of half precision is 2^-10, one of r11g11b10f's blue 2^-5.
    EXPECT_EQ(of_pixel(1.0, 1.0F - 0x1p-10F, "rgba16f").wrong, 0U);
    EXPECT_EQ(of_pixel(1.0, 1.0F - 0x1p-9F, "rgba16f").wrong, 1U);
    EXPECT_EQ(of_pixel(1.0, 1.0F - 0x1p-9F, "rgba16f", 4).wrong, 0U) << "a sum stored four times";
    EXPECT_EQ(of_pixel(1.0, 1.0F - 0x1p-5F, "r11g11b10f").wrong, 0U);
    EXPECT_EQ(of_pixel(1.0, 1.0F - 0x1p-4F, "r11g11b10f").wrong, 1U);
    EXPECT_EQ(of_pixel(1e-9, 0.0F, "rgba16f").wrong, 0U) << "below its least number";
    EXPECT_EQ(of_pixel(1e-9, 0.0F, "rgba32f").wrong, 1U);
    EXPECT_EQ(of_pixel(0x1p-15, 0.0F, "r11g11b10f").wrong, 0U) << "a denormal of it";
}

TEST(FindFaults, NaNIsAlwaysOne) {
    for (const char* hdr : {"rgba32f", "rgba16f", "r11g11b10f"}) {
        EXPECT_EQ(of_pixel(1.0, std::nanf(""), hdr).non_finite, 1U);
        EXPECT_EQ(of_pixel(1e6, std::nanf(""), hdr).non_finite, 1U);
        EXPECT_EQ(of_pixel(1.0, std::nanf(""), hdr, 1, 0.0, false).non_finite, 1U)
            << "where nothing else is known, too";
    }
}

TEST(FindFaults, InfinityIsWhatA16BitFormatMakesOfTooMuch) {
    EXPECT_EQ(of_pixel(1e6, kInfinity, "rgba16f").saturated, 1U);
    EXPECT_EQ(of_pixel(1e6, 65504.0F, "rgba16f").saturated, 1U);
    EXPECT_FALSE(of_pixel(1e6, kInfinity, "rgba16f").any());
    EXPECT_EQ(of_pixel(1e6, kInfinity, "rgba32f").non_finite, 1U);
    EXPECT_EQ(of_pixel(100.0, kInfinity, "rgba16f").non_finite, 1U);
    EXPECT_EQ(of_pixel(1e6, 100.0F, "rgba16f").wrong, 1U);
    EXPECT_EQ(of_pixel(100.0, 50.0F, "rgba16f", 1, 0.0, true, true).saturated, 1U) << "saturated on the way";
}

TEST(FindFaults, WhatIsNotJudgedMustOnlyBeFinite) {
    EXPECT_FALSE(of_pixel(1.0, 7.0F, "rgba32f", 1, 0.0, false).any());
    EXPECT_TRUE(of_pixel(1.0, kInfinity, "rgba32f", 1, 0.0, false).any());
}

TEST(RelativeErrorQuantile, LeavesOutWhatIsDarkOrNotJudged) {
    Image image(4, 1, ColorSpace::linear);
    image.rgb = {1.1F, 1.0F, 1.0F, 2.0F, 2.0F, 2.0F, 5.0F, 5.0F, 5.0F, 9.0F, 9.0F, 9.0F};
    const std::vector<glm::dvec3> exact{glm::dvec3(1.0), glm::dvec3(2.0), glm::dvec3(0.0), glm::dvec3(1.0)};
    const std::vector<bool> judged{true, true, true, false};
    EXPECT_NEAR(relative_error_quantile(image, exact, judged, 1e-3, 1.0), 0.1, 1e-6);
    EXPECT_NEAR(relative_error_quantile(image, exact, judged, 1e-3, 0.0), 0.0, 1e-6);
}

}  // namespace
}  // namespace lightsweep
