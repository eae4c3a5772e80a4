// The picture of an error: dark where images agree, brighter with the difference, green where a pixel is not finite.
#include "bench/metrics/error_map.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace lightsweep {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;

std::vector<float> pixel(const Image& image, int x) { return {image.pixel(x, 0), image.pixel(x, 0) + 3}; }
float brightness(const Image& image, int x) {
    return image.pixel(x, 0)[0] + image.pixel(x, 0)[1] + image.pixel(x, 0)[2];
}

TEST(ErrorMap, IsBlackOnEqualImages) {
    const Image image(8, 5, ColorSpace::linear);
    const Image map = error_map(image, image);
    EXPECT_EQ(map.width, 8);
    EXPECT_EQ(map.height, 5);
    EXPECT_EQ(map.space, ColorSpace::display);
    EXPECT_THAT(map.rgb, Each(FloatNear(0.0F, 0.02F)));
}

TEST(ErrorMap, RunsThroughMagmaByTheLogarithmOfTheLargestChannel) {
    const Image reference(6, 1, ColorSpace::linear);
    Image test = reference;
    test.pixel(1, 0)[0] = 50;     // the largest: magma's end
    test.pixel(2, 0)[1] = -0.5F;  // two of four decades below: magma's middle, whatever the channel and the sign
    test.pixel(3, 0)[2] = 5e-3F;  // four decades below: black
    test.pixel(4, 0)[2] = 1e-6F;
    test.pixel(5, 0)[0] = std::numeric_limits<float>::quiet_NaN();
    const Image map = error_map(reference, test);
    // matplotlib's table: magma(1) = (0.987, 0.991, 0.750), magma(0.5) = (0.716, 0.215, 0.475).
    const auto near = [](float v) { return FloatNear(v, 0.025F); };
    EXPECT_THAT(pixel(map, 0), Each(near(0)));
    EXPECT_THAT(pixel(map, 1), ElementsAre(near(0.987F), near(0.991F), near(0.750F)));
    EXPECT_THAT(pixel(map, 2), ElementsAre(near(0.716F), near(0.215F), near(0.475F)));
    EXPECT_THAT(pixel(map, 3), Each(near(0)));
    EXPECT_THAT(pixel(map, 4), Each(near(0)));
    EXPECT_THAT(pixel(map, 5), ElementsAre(0, 1, 0));
}

TEST(ErrorMap, IsBrighterForALargerError) {
    const Image reference(50, 1, ColorSpace::linear);
    Image test = reference;
    float error = 1e-3F;
    for (int x = 0; x < 50; ++x, error *= 1.2F) test.pixel(x, 0)[0] = error;
    const Image map = error_map(reference, test);
    for (int x = 1; x < 50; ++x) EXPECT_GT(brightness(map, x), brightness(map, x - 1)) << x;
    for (const float v : map.rgb) EXPECT_TRUE(v >= 0 && v <= 1) << v;
}

TEST(ErrorMap, RefusesImagesOfDifferentSize) {
    EXPECT_THROW(error_map(Image(2, 2, ColorSpace::linear), Image(3, 2, ColorSpace::linear)), InputError);
}

}  // namespace
}  // namespace lightsweep
