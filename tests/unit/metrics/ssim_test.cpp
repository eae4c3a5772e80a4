// SSIM against closed forms, and against a plain implementation in double precision (see pattern()).
#include "bench/metrics/image_error.h"
#include "tests/unit/metrics/pictures.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

std::optional<double> ssim(const Image& reference, const Image& test) {
    return measure_error(image_pair(reference, test)).value("ssim");
}

TEST(Ssim, AgreesWithAPlainImplementation) {
    const Image r = pattern(0, ColorSpace::display), v = pattern(1, ColorSpace::display);
    EXPECT_NEAR(ssim(r, v).value(), -0.06972938041026894, 1e-12);
    EXPECT_NEAR(ssim(r, blend(r, v, 0.25F)).value(), 0.9159388382556641, 1e-12);
}

TEST(Ssim, OfFlatPicturesComparesTheirMeansAlone) {
    // (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4)
    const Image r = flat(11, 11, 0.25F, 0.25F, 0.25F, ColorSpace::display);
    const Image v = flat(11, 11, 0.75F, 0.75F, 0.75F, ColorSpace::display);
    EXPECT_NEAR(ssim(r, v).value(), 0.3751 / 0.6251, 1e-9);
}

TEST(Ssim, SeesLumaAlone) {
    // Red and green of one luma (BT.601): 0.299 * 0.587 either way.
    const Image r = flat(12, 12, 0.587F, 0, 0, ColorSpace::display);
    const Image v = flat(12, 12, 0, 0.299F, 0, ColorSpace::display);
    EXPECT_NEAR(ssim(r, v).value(), 1, 1e-9);
}

TEST(Ssim, IsTheSameOfTransposedPictures) {
    const Image r = noise(19, 40, 1), v = noise(19, 40, 2);
    EXPECT_NEAR(ssim(r, v).value(), ssim(transposed(r), transposed(v)).value(), 1e-12);
}

TEST(Ssim, IsNotDefinedBelowOneWindow) {
    EXPECT_FALSE(ssim(noise(10, 30, 1), noise(10, 30, 2)).has_value());
    EXPECT_FALSE(ssim(noise(30, 10, 1), noise(30, 10, 2)).has_value());
    EXPECT_TRUE(ssim(noise(11, 11, 1), noise(11, 11, 2)).has_value());
}

TEST(Ssim, LeavesOutTheWindowsOfAPixelThatIsNotFinite) {
    // Of 20 x 11 the windows are those around x = 5..14 of the middle row; NaN at x = 19 is in that around 14 alone.
    const Image r = noise(20, 11, 1), v = noise(20, 11, 2);
    Image broken = v;
    broken.pixel(19, 4)[1] = kNan;
    const auto without_last_column = [](const Image& image) {
        Image cut(19, 11, image.space);
        for (int y = 0; y < 11; ++y) std::copy_n(image.pixel(0, y), 57, cut.pixel(0, y));
        return cut;
    };
    EXPECT_NEAR(ssim(r, broken).value(), ssim(without_last_column(r), without_last_column(v)).value(), 1e-15);
}

}  // namespace
}  // namespace lightsweep
