// Display values against numbers worked out apart, and what becomes of values that are none.
#include "renderer/reference/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace lightsweep {
namespace {

float displayed(float radiance) {
    Image image(1, 1, ColorSpace::linear);
    image.rgb = {radiance, 0, 0};
    return tone_mapped(image).rgb[0];
}

TEST(ToneMapped, FollowsTheFitAndTheSrgbCurve) {
    // From the two formulas in another language: x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), then IEC 61966-2-1.
    EXPECT_FLOAT_EQ(displayed(0.001F), 0.0029875662F);  // the straight part
    EXPECT_FLOAT_EQ(displayed(0.05F), 0.232862335F);
    EXPECT_FLOAT_EQ(displayed(0.18F), 0.553457572F);
    EXPECT_FLOAT_EQ(displayed(1.0F), 0.908230496F);
    EXPECT_FLOAT_EQ(displayed(4.0F), 0.98822271F);
}

TEST(ToneMapped, EndsAtBlackAndWhite) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(displayed(0.0F), 0.0F);
    EXPECT_EQ(displayed(-1.0F), 0.0F);
    EXPECT_EQ(displayed(-kInfinity), 0.0F);
    EXPECT_EQ(displayed(std::numeric_limits<float>::quiet_NaN()), 0.0F);
    EXPECT_EQ(displayed(100.0F), 1.0F);
    EXPECT_EQ(displayed(std::numeric_limits<float>::max()), 1.0F);
    EXPECT_EQ(displayed(kInfinity), 1.0F);
}

TEST(ToneMapped, NeverFalls) {
    float last = 0.0F;
    for (float radiance = 1e-6F; radiance < 1e6F; radiance *= 1.01F) {
        EXPECT_GE(displayed(radiance), last) << radiance;
        last = displayed(radiance);
    }
}

TEST(ToneMapped, KeepsPixelsInPlace) {
    Image image(2, 2, ColorSpace::linear);
    image.rgb = {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F, 0.8F, 0.9F, 1.0F, 1.1F, 1.2F};
    const Image mapped = tone_mapped(image);
    EXPECT_EQ(mapped.width, 2);
    EXPECT_EQ(mapped.height, 2);
    EXPECT_EQ(mapped.space, ColorSpace::display);
    for (size_t i = 0; i < image.rgb.size(); ++i) EXPECT_EQ(mapped.rgb[i], displayed(image.rgb[i]));
}

}  // namespace
}  // namespace lightsweep
