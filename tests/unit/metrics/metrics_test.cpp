// The error metrics on numbers worked out by hand, and the properties that every metric of the table must have.
#include "bench/metrics/metrics.h"

#include "bench/metrics/image_error.h"
#include "renderer/base/error.h"
#include "renderer/base/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <set>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image image_of(int width, int height, std::vector<float> rgb, ColorSpace space = ColorSpace::linear) {
    Image image(width, height, space);
    image.rgb = std::move(rgb);
    return image;
}

Image noise(int width, int height, uint64_t seed, ColorSpace space = ColorSpace::linear) {
    Random random(seed);
    Image image(width, height, space);
    for (float& v : image.rgb) v = static_cast<float>(random.uniform());
    return image;
}

double measure(std::string_view key, const Image& reference, const Image& test) {
    const auto value = compare_images(reference, test).value(key);
    EXPECT_TRUE(value.has_value()) << key;
    return value.value_or(-1);
}

class EveryMetric : public ::testing::TestWithParam<const Metric*> {
  protected:
    std::optional<double> measure(const Image& reference, const Image& test) const {
        return GetParam()->measure(reference, test);
    }
};

TEST_P(EveryMetric, IsNothingOnEqualImages) {
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::display}) {
        const Image image = noise(33, 21, 1, space);
        EXPECT_EQ(measure(image, image).value_or(0), 0.0);
    }
}

TEST_P(EveryMetric, IsFiniteOrAbsentWhateverTheImagesHold) {
    for (const float a : {0.0F, -0.01F, 1.0F, -3e38F, 3e38F, 1e-45F, kInf, -kInf, kNan})
        for (const float b : {0.0F, -0.01F, 1.0F, -3e38F, 3e38F, kInf, kNan})
            for (const ColorSpace space : {ColorSpace::linear, ColorSpace::display}) {
                const auto value = measure(image_of(1, 1, {a, 0, 0}, space), image_of(1, 1, {b, 0, 0}, space));
                EXPECT_TRUE(std::isfinite(value.value_or(0))) << a << " " << b;
            }
}

TEST_P(EveryMetric, DoesNotDependOnTheOrderOfPixels) {
    const Image r = noise(64, 40, 1), v = noise(64, 40, 2);
    Image r2 = r, v2 = v;
    for (size_t i = 0; i < r.pixel_count(); ++i) {
        const size_t to = (i * 7 + 3) % r.pixel_count();  // 7 and 2560 have no common factor
        for (size_t c = 0; c < 3; ++c) {
            r2.rgb[3 * to + c] = r.rgb[3 * i + c];
            v2.rgb[3 * to + c] = v.rgb[3 * i + c];
        }
    }
    EXPECT_NEAR(measure(r, v).value(), measure(r2, v2).value(), 1e-12 * measure(r, v).value());
}

TEST_P(EveryMetric, IsTheSameToTheBitForAnyNumberOfThreads) {
    const Image r = noise(131, 257, 1), v = noise(131, 257, 2);
    const auto with_threads = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return measure(r, v);
    };
    const auto one = with_threads(1);
    for (int repeat = 0; repeat < 20; ++repeat) ASSERT_EQ(with_threads(4), one);
}

INSTANTIATE_TEST_SUITE_P(Table, EveryMetric, ::testing::ValuesIn(all_metrics().begin(), all_metrics().end()),
                         [](const auto& metric) { return std::string(metric.param->key); });

TEST(Metrics, HaveUniqueKeysAndASummary) {
    std::set<std::string_view> keys;
    for (const Metric* metric : all_metrics()) {
        EXPECT_TRUE(keys.insert(metric->key).second) << metric->key;
        EXPECT_FALSE(metric->summary.empty()) << metric->key;
    }
}

TEST(Metrics, GrowWorseWithTheError) {
    const Image r = noise(40, 40, 1), d = noise(40, 40, 2);
    for (const Metric* metric : all_metrics()) {
        if (metric->key == "nonfinite_px") continue;            // counts pixels, whatever their error
        const double sign = metric->key == "psnr_db" ? -1 : 1;  // more decibels are better
        double previous = -std::numeric_limits<double>::infinity();
        for (const float scale : {0.01F, 0.02F, 0.1F, 1.0F}) {
            Image v = r;
            for (size_t i = 0; i < v.rgb.size(); ++i) v.rgb[i] += scale * d.rgb[i];
            const double value = sign * metric->measure(r, v).value();
            EXPECT_GT(value, previous) << metric->key << " " << scale;
            previous = value;
        }
    }
}

// Two pixels: differences 0.5, 0, 0 and 0, -0.25, 0.
const Image kReference = image_of(2, 1, {0.5F, 1, 0, 2, 0.25F, 0});
const Image kTest = image_of(2, 1, {1, 1, 0, 2, 0, 0});

TEST(Metrics, GiveTheNumbersWorkedOutByHand) {
    // (0.25 + 0.0625) / 6 = 0.0520833...; its root is 0.228218.
    EXPECT_NEAR(measure("rmse", kReference, kTest), 0.2282177322938192, 1e-15);
    EXPECT_EQ(measure("max_abs", kReference, kTest), 0.5);
    // ((0.5 / 0.51)^2 + (0.25 / 0.26)^2) / 6
    EXPECT_NEAR(measure("mrse", kReference, kTest), (0.9611687812379854 + 0.9245562130177515) / 6, 1e-12);
    // Peak 2: 10 log10(4 / 0.0520833) = 10 log10(76.8)
    EXPECT_NEAR(measure("psnr_db", kReference, kTest), 18.853612200315, 1e-10);
    EXPECT_EQ(measure("nonfinite_px", kReference, kTest), 0);
}

TEST(Psnr, OfDisplayValuesHasPeakOne) {
    // A constant error of 0.1: 20 dB. Of 1/255, one step of 8 bits: 48.1308 dB.
    const auto flat = [](float v) { return image_of(4, 4, std::vector<float>(48, v), ColorSpace::display); };
    EXPECT_NEAR(measure("psnr_db", flat(0.0F), flat(0.1F)), 20.0, 1e-6);
    EXPECT_NEAR(measure("psnr_db", flat(0.5F), flat(0.5F + 1 / 255.0F)), 48.1308, 1e-4);
}

TEST(Psnr, OfRadianceDoesNotChangeWithTheExposure) {
    Image r = noise(20, 20, 1), v = noise(20, 20, 2);
    const double before = measure("psnr_db", r, v);
    for (Image* image : {&r, &v})
        for (float& value : image->rgb) value *= 64;
    EXPECT_NEAR(measure("psnr_db", r, v), before, 1e-9);
}

TEST(Mrse, IsTakenOnLinearValues) {
    // Display 0.5 is 0.2140411 linear, 1 is 1: ((1 - 0.2140411) / 0.2240411)^2 = 12.30677.
    const Image r = image_of(1, 1, {0.5F, 0.5F, 0.5F}, ColorSpace::display);
    const Image v = image_of(1, 1, {1, 1, 1}, ColorSpace::display);
    EXPECT_NEAR(measure("mrse", r, v), 12.30677, 2e-5);
}

TEST(Metrics, LeaveNonFinitePixelsOutAndCountThem) {
    Image r = kReference, v = kTest;
    const auto append = [](Image& image, std::vector<float> pixel) {
        image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.end());
    };
    append(r, {1, 1, 1}), append(v, {1, kNan, 9});
    append(r, {kInf, 0, 0}), append(v, {kInf, 0, 7});
    append(r, {0, 0, -kInf}), append(v, {5, 5, 5});
    r.width = v.width = 5;
    for (const char* key : {"rmse", "max_abs", "mrse", "psnr_db"})
        EXPECT_EQ(measure(key, r, v), measure(key, kReference, kTest)) << key;
    EXPECT_EQ(measure("nonfinite_px", r, v), 3);
}

TEST(Metrics, AreAbsentWithoutAFinitePixel) {
    const Image nothing = image_of(1, 1, {kNan, 0, 0});
    const ImageError error = compare_images(nothing, nothing);
    for (const char* key : {"rmse", "max_abs", "mrse", "psnr_db"}) EXPECT_FALSE(error.value(key)) << key;
    EXPECT_EQ(error.value("nonfinite_px"), 1);
}

TEST(CompareImages, KnowsIdenticalFromEqualSoFar) {
    EXPECT_TRUE(compare_images(kReference, kReference).identical);
    EXPECT_FALSE(compare_images(kReference, kTest).identical);
    const Image nan = image_of(1, 1, {kNan, kInf, 0});
    EXPECT_TRUE(compare_images(nan, nan).identical);
    EXPECT_FALSE(compare_images(nan, image_of(1, 1, {0, kInf, 0})).identical);
    // Differs only in a pixel that no metric but nonfinite_px looks at.
    EXPECT_FALSE(compare_images(image_of(1, 1, {kInf, 0, 0}), image_of(1, 1, {kInf, 1, 0})).identical);
}

TEST(CompareImages, RefusesWhatCannotBeCompared) {
    EXPECT_THAT([] { compare_images(Image(640, 360, ColorSpace::linear), Image(320, 180, ColorSpace::linear)); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("640x360"), HasSubstr("320x180"), HasSubstr("same size"))));
    EXPECT_THAT([] { compare_images(Image(6, 2, ColorSpace::linear), Image(4, 3, ColorSpace::linear)); },
                ThrowsMessage<InputError>(HasSubstr("6x2")));
    EXPECT_THAT([] { compare_images(Image(2, 2, ColorSpace::linear), Image(2, 2, ColorSpace::display)); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("linear"), HasSubstr("display"))));
}

TEST(CompareImages, WritesStrictJson) {
    const auto json = to_json(compare_images(kReference, kTest));
    EXPECT_EQ(json.size(), all_metrics().size() + 1);
    EXPECT_EQ(json.at("max_abs"), 0.5);
    EXPECT_EQ(json.at("identical"), false);

    const auto same = to_json(compare_images(kReference, kReference));
    EXPECT_TRUE(same.at("psnr_db").is_null());
    EXPECT_EQ(same.at("rmse"), 0.0);

    const Image nothing = image_of(1, 1, {kNan, 0, 0});
    const std::string text = to_json(compare_images(nothing, nothing)).dump();
    EXPECT_THAT(text, HasSubstr(R"("rmse":null)"));
    EXPECT_EQ(nlohmann::json::parse(text).at("nonfinite_px"), 1);
}

}  // namespace
}  // namespace lightsweep
