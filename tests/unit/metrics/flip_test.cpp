// FLIP against closed forms, and against a plain implementation in double precision (see pattern()).
#include "bench/metrics/flip.h"

#include "bench/metrics/flip_filters.h"
#include "renderer/base/error.h"
#include "tests/unit/metrics/pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightsweep {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::Pointwise;

double mean(const FlipMap& map) {
    return std::accumulate(map.error.begin(), map.error.end(), 0.0) / static_cast<double>(map.error.size());
}
double largest(const FlipMap& map) { return *std::ranges::max_element(map.error); }
float at(const FlipMap& map, int x, int y) { return map.error[static_cast<size_t>(y * map.width + x)]; }

Image display(float r, float g, float b) { return flat(9, 7, r, g, b, ColorSpace::display); }
Image linear(float v) { return flat(9, 7, v, v, v, ColorSpace::linear); }

TEST(LdrFlip, AgreesWithAPlainImplementation) {
    const Image r = pattern(0, ColorSpace::display), v = pattern(1, ColorSpace::display);
    const FlipMap map = ldr_flip(r, v);
    EXPECT_EQ(map.exposures.count, 0);
    EXPECT_NEAR(mean(map), 0.3333605175652486, 1e-6);
    EXPECT_NEAR(largest(map), 0.907814923609613, 1e-5);
    EXPECT_NEAR(at(map, 0, 0), 0.3099828453911142, 1e-5);
    EXPECT_NEAR(at(map, 0, 22), 0.25103062576729396, 1e-5);
    EXPECT_NEAR(at(map, 17, 11), 0.34057444057028635, 1e-5);

    const FlipMap nearer = ldr_flip(r, blend(r, v, 0.25F));
    EXPECT_NEAR(mean(nearer), 0.22415174337374869, 1e-6);
    EXPECT_NEAR(largest(nearer), 0.5333103857510003, 1e-5);

    const FlipMap from_closer = ldr_flip(r, v, 30);
    EXPECT_NEAR(mean(from_closer), 0.664462397217293, 1e-6);
    EXPECT_NEAR(largest(from_closer), 0.9770469163437215, 1e-5);
}

TEST(HdrFlip, AgreesWithAPlainImplementation) {
    Image r = pattern(0, ColorSpace::linear), v = pattern(1, ColorSpace::linear);
    for (Image* image : {&r, &v})
        for (int y = 0; y < image->height; ++y)
            for (int x = 0; x < image->width; ++x)
                for (int c = 0; c < 3; ++c) {
                    float& value = image->pixel(x, y)[c];
                    value = std::ldexp(value * value, x / 4);
                }
    const FlipMap map = hdr_flip(r, blend(r, v, 0.25F));
    EXPECT_NEAR(map.exposures.start, -5.614840290167251, 1e-5);
    EXPECT_NEAR(map.exposures.stop, -0.18424840450223962, 1e-5);
    EXPECT_EQ(map.exposures.count, 6);
    EXPECT_NEAR(mean(map), 0.25771474544852474, 1e-6);
    EXPECT_NEAR(largest(map), 0.6070195903416168, 1e-5);
    EXPECT_NEAR(at(map, 17, 11), 0.29183457114796046, 1e-5);
}

TEST(LdrFlip, OfFlatPicturesIsTheirColorDifferenceAlone) {
    // The largest distance, from green to blue, is 41.276098 when compressed: the paper's 41.2760. Black to white is
    // 100, compressed 25.118864: 0.95 + 0.05 * (25.118864 - 0.4 * 41.276098) / (0.6 * 41.276098).
    EXPECT_THAT(ldr_flip(display(0, 0, 0), display(1, 1, 1)).error, Each(FloatNear(0.96737976F, 2e-6F)));
    EXPECT_THAT(ldr_flip(display(0, 1, 0), display(0, 0, 1)).error, Each(FloatNear(1.0F, 2e-6F)));
    // Lightness 53.389 to 63.223 (cube roots of 0.214041 and 0.318547): below the knee, 0.95 * 9.834^0.7 / 16.510439.
    EXPECT_THAT(ldr_flip(display(0.5F, 0.5F, 0.5F), display(0.6F, 0.6F, 0.6F)).error,
                Each(FloatNear(0.28501300F, 5e-6F)));
}

TEST(HdrFlip, ShowsTheReferenceWhereTheToneCurveIs85Percent) {
    // The curve takes 2.1186 to 0.85: log2(2.1186 / 4) for the brightest pixel and the median one alike.
    const FlipMap map = hdr_flip(linear(4), linear(1));
    EXPECT_NEAR(map.exposures.start, -0.9167033415489013, 1e-6);
    EXPECT_EQ(map.exposures.stop, map.exposures.start);
    EXPECT_EQ(map.exposures.count, 2);
    EXPECT_THAT(map.error, Each(FloatNear(0.4748999F, 3e-6F)));
}

TEST(HdrFlip, DoesNotChangeWithTheExposure) {
    Image r = noise(40, 30, 1), v = noise(40, 30, 2);
    const FlipMap before = hdr_flip(r, v);
    for (Image* image : {&r, &v})
        for (float& value : image->rgb) value *= 64;
    const FlipMap after = hdr_flip(r, v);
    EXPECT_NEAR(after.exposures.start, before.exposures.start - 6, 1e-9);
    EXPECT_THAT(after.error, Pointwise(FloatNear(1e-5F), before.error));
}

TEST(HdrFlip, OfAMostlyBlackReferenceIsExposedForWhatIsNotBlack) {
    Image r = linear(0), v = r;
    r.pixel(4, 3)[1] = v.pixel(4, 3)[1] = 2;
    v.pixel(0, 0)[0] = 1;
    const FlipMap map = hdr_flip(r, v);
    // The luminance of (0, 2, 0) is 1.4304, and it is the brightest and the median of what is not black.
    EXPECT_NEAR(map.exposures.start, hdr_flip(linear(1.4304F), linear(1)).exposures.start, 1e-6);
    EXPECT_EQ(map.exposures.stop, map.exposures.start);
    EXPECT_GT(at(map, 0, 0), 0.1F);
    EXPECT_EQ(hdr_flip(linear(0), v).exposures.start, 0);
    EXPECT_GT(at(hdr_flip(linear(0), v), 0, 0), 0.1F);
}

TEST(Flip, IsTheSameOfTransposedPictures) {
    const Image r = noise(90, 75, 1), v = noise(90, 75, 2);  // over one band of rows
    const FlipMap map = hdr_flip(r, v), turned = hdr_flip(transposed(r), transposed(v));
    ASSERT_EQ(turned.width, 75);
    for (int y = 0; y < 75; ++y)
        for (int x = 0; x < 90; ++x) ASSERT_NEAR(at(map, x, y), at(turned, y, x), 2e-5) << x << " " << y;
}

TEST(Flip, SeesADifferenceOnlyWhereItReaches) {
    const Image r = noise(120, 150, 1, ColorSpace::display);
    Image v = r;
    v.pixel(60, 64)[0] = 1 - v.pixel(60, 64)[0];
    const FlipMap map = ldr_flip(r, v);
    const int reach = flip_filters(kPixelsPerDegree).radius;
    EXPECT_EQ(reach, 10);  // 3 * 0.045016 degrees at 67 pixels each
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 120; ++x) {
            const int distance = std::max(std::abs(x - 60), std::abs(y - 64));
            if (distance > reach) {
                ASSERT_EQ(at(map, x, y), 0) << x << " " << y;
            } else if (distance <= 1) {
                ASSERT_GT(at(map, x, y), 0) << x << " " << y;
            }
        }
}

TEST(Flip, DoesNotSpreadWhatIsNotFinite) {
    const Image r = noise(40, 30, 1, ColorSpace::display);
    Image v = r;
    v.pixel(20, 15)[2] = kNan;
    const FlipMap map = ldr_flip(r, v);
    EXPECT_TRUE(std::isnan(at(map, 20, 15)));
    // The pixel is black in both: no difference is left.
    EXPECT_EQ(std::ranges::count_if(map.error, [](float e) { return e == 0; }), 40 * 30 - 1);
    const Image picture = flip_picture(map);
    EXPECT_THAT(std::vector<float>(picture.pixel(20, 15), picture.pixel(20, 15) + 3), ElementsAre(0, 1, 0));
}

TEST(Flip, TakesThePairsLinearValuesOnlyForALinearReference) {
    const Image r = noise(20, 20, 1), v = noise(20, 20, 2);
    Image shown = v;
    shown.space = ColorSpace::display;
    EXPECT_EQ(flip(image_pair(r, shown)).error, hdr_flip(r, converted(shown, ColorSpace::linear)).error);
    EXPECT_EQ(flip(image_pair(shown, r)).error, ldr_flip(shown, converted(r, ColorSpace::display)).error);
}

TEST(FlipFilters, KeepFlatColorsAndSumToOne) {
    for (const double pixels_per_degree : {1.0, 30.0, kPixelsPerDegree, 200.0}) {
        const FlipFilters filters = flip_filters(pixels_per_degree);
        const auto sum = [](const RowFilter<float>& filter, auto of_weight) {
            double total = of_weight(filter.weights[0]);
            for (size_t k = 1; k < filter.weights.size(); ++k) total += 2 * of_weight(filter.weights[k]);
            return total;
        };
        const auto weight = [](float w) { return double{w}; };
        const auto positive = [](float w) { return std::max(0.0, double{w}); };
        EXPECT_NEAR(sum(filters.achromatic, weight), 1, 1e-6);
        EXPECT_NEAR(sum(filters.red_green, weight), 1, 1e-6);
        EXPECT_NEAR(
            std::pow(sum(filters.wide_blue_yellow, weight), 2) + std::pow(sum(filters.narrow_blue_yellow, weight), 2),
            1, 1e-6);
        EXPECT_NEAR(sum(filters.gaussian, weight), 1, 1e-6);
        EXPECT_NEAR(sum(filters.edge, weight), 2, 1e-6);  // 1 on its side, -1 on the other
        EXPECT_EQ(filters.edge.weights[0], 0);
        EXPECT_NEAR(sum(filters.point, positive), 1, 1e-6);
        EXPECT_NEAR(sum(filters.point, weight), 0, 1e-6);
    }
}

TEST(FlipMapFile, HoldsTheErrorsIn16Bits) {
    const std::filesystem::path file =
        std::filesystem::path(::testing::TempDir()) / ("lightsweep_flip_map_" + std::to_string(::getpid()) + ".png");
    const FlipMap map{.width = 3, .height = 2, .error = {0, 1e-4F, 0.5F, 1, kNan, 1.0F / 65535}, .exposures = {}};
    write_flip_map(map, file);
    const Image back = read_image(file);
    std::filesystem::remove(file);
    ASSERT_EQ(back.width, 3);
    ASSERT_EQ(back.height, 2);
    for (size_t i = 0; i < map.error.size(); ++i) {
        EXPECT_NEAR(back.rgb[3 * i], i == 4 ? 0.0F : map.error[i], 0.5 / 65535 + 1e-7) << i;
    }
    EXPECT_THROW(write_flip_map(map, "/nowhere/at/all.png"), InputError);
}

TEST(FlipPicture, RunsThroughMagma) {
    // matplotlib's table: magma(1) = (0.987, 0.991, 0.750), magma(0.5) = (0.716, 0.215, 0.475).
    const FlipMap map{.width = 3, .height = 1, .error = {0, 0.5F, 1}, .exposures = {}};
    const Image picture = flip_picture(map);
    EXPECT_EQ(picture.space, ColorSpace::display);
    const float expected[] = {0.001F, 0.000F, 0.014F, 0.716F, 0.215F, 0.475F, 0.987F, 0.991F, 0.750F};
    EXPECT_THAT(picture.rgb, Pointwise(FloatNear(0.025F), expected));
}

}  // namespace
}  // namespace lightsweep
