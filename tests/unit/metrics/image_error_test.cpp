// Two images as the metrics take them, and all metrics of them as one record.
#include "bench/metrics/image_error.h"

#include "renderer/base/error.h"
#include "tests/unit/metrics/pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

bool identical(const Image& reference, const Image& test) {
    return measure_error(image_pair(reference, test)).identical;
}

TEST(ImagePair, HoldsLinearAndDisplayValuesOfEither) {
    // The sRGB curve: 0.5 shows as 0.735357, and stands for 0.214041.
    const Image linear = image_of(1, 1, {0.5F, 2, -1});
    const Image display = image_of(1, 1, {0.5F, 1, 0}, ColorSpace::display);
    const auto check = [](const Image& of_linear, const Image& shown, const Image& of_display, const Image& light) {
        EXPECT_THAT(of_linear.rgb, ElementsAre(0.5F, 2, -1));
        EXPECT_THAT(shown.rgb, ElementsAre(FloatNear(0.735357F, 1e-6F), 1, 0));
        EXPECT_THAT(of_display.rgb, ElementsAre(0.5F, 1, 0));
        EXPECT_THAT(light.rgb, ElementsAre(FloatNear(0.214041F, 1e-6F), 1, 0));
    };
    const ImagePair hdr = image_pair(linear, display);
    EXPECT_TRUE(hdr.hdr);
    check(hdr.reference_linear, hdr.reference_display, hdr.test_display, hdr.test_linear);
    const ImagePair ldr = image_pair(display, linear);
    EXPECT_FALSE(ldr.hdr);
    check(ldr.test_linear, ldr.test_display, ldr.reference_display, ldr.reference_linear);
}

TEST(ImagePair, KeepsWhatIsNotFinite) {
    const ImagePair pair = image_pair(image_of(1, 1, {kNan, kInf, -kInf}), Image(1, 1, ColorSpace::linear));
    for (const float v : pair.reference_display.rgb) EXPECT_FALSE(std::isfinite(v)) << v;
}

TEST(ImagePair, RefusesImagesOfDifferentSize) {
    EXPECT_THAT([] { image_pair(Image(640, 360, ColorSpace::linear), Image(320, 180, ColorSpace::linear)); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("640x360"), HasSubstr("320x180"), HasSubstr("same size"))));
    EXPECT_THAT([] { image_pair(Image(6, 2, ColorSpace::linear), Image(4, 3, ColorSpace::display)); },
                ThrowsMessage<InputError>(HasSubstr("6x2")));
}

TEST(ImageError, KnowsIdenticalFromEqualSoFar) {
    const Image image = image_of(1, 1, {0.5F, 1, 0});
    EXPECT_TRUE(identical(image, image));
    EXPECT_FALSE(identical(image, image_of(1, 1, {0.5F, 1, 1e-30F})));
    const Image nan = image_of(1, 1, {kNan, kInf, 0});
    EXPECT_TRUE(identical(nan, nan));
    EXPECT_FALSE(identical(nan, image_of(1, 1, {0, kInf, 0})));
    // Differs only in a pixel that no metric but nonfinite_px looks at.
    EXPECT_FALSE(identical(image_of(1, 1, {kInf, 0, 0}), image_of(1, 1, {kInf, 1, 0})));
    // Differs only above what a display shows.
    EXPECT_FALSE(identical(image_of(1, 1, {1, 1, 1}, ColorSpace::display), image_of(1, 1, {1, 1, 2})));
}

TEST(ImageError, WritesStrictJson) {
    const Image r = noise(12, 12, 1), v = noise(12, 12, 2);
    const auto json = to_json(measure_error(image_pair(r, v)));
    EXPECT_EQ(json.size(), metric_value_keys().size() + 1);
    EXPECT_EQ(json.begin().key(), "rmse");
    EXPECT_EQ(json.at("identical"), false);
    EXPECT_GE(json.at("flip_exposure_count"), 2);

    const auto same = to_json(measure_error(image_pair(r, r)));
    EXPECT_TRUE(same.at("psnr_db").is_null());
    EXPECT_EQ(same.at("rmse"), 0.0);
    EXPECT_EQ(same.at("ssim"), 1.0);
    EXPECT_EQ(same.at("identical"), true);

    const Image nothing = image_of(1, 1, {kNan, 0, 0}, ColorSpace::display);
    const std::string text = to_json(measure_error(image_pair(nothing, nothing))).dump();
    EXPECT_THAT(text, AllOf(HasSubstr(R"("rmse":null)"), HasSubstr(R"("flip_exposure_count":null)")));
    EXPECT_EQ(nlohmann::json::parse(text).at("nonfinite_px"), 1);
}

}  // namespace
}  // namespace lightsweep
