// The error metrics on numbers worked out by hand, and the properties that every metric of the table must have.
#include "bench/metrics/metrics.h"

#include "bench/metrics/image_error.h"
#include "tests/unit/metrics/pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <set>

namespace lightsweep {
namespace {

using Values = std::vector<std::optional<double>>;

double measure(std::string_view key, const Image& reference, const Image& test) {
    const auto value = measure_error(image_pair(reference, test)).value(key);
    EXPECT_TRUE(value.has_value()) << key;
    return value.value_or(-1);
}

class EveryMetric : public ::testing::TestWithParam<const Metric*> {
  protected:
    Values measure(const Image& reference, const Image& test) const {
        return GetParam()->measure(image_pair(reference, test));
    }
};

TEST_P(EveryMetric, SaysOfEqualImagesThatThereIsNoDifference) {
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::display}) {
        const Image image = noise(33, 21, 1, space);
        const Values values = measure(image, image);
        for (size_t i = 0; i < values.size(); ++i) {
            const std::string_view key = GetParam()->values[i];
            if (key.starts_with("flip_exposure")) continue;  // of the reference alone
            if (key == "psnr_db") {
                EXPECT_FALSE(values[i].has_value());
            } else {
                EXPECT_EQ(values[i], key == "ssim" ? 1.0 : 0.0) << key;
            }
        }
    }
}

TEST_P(EveryMetric, IsFiniteOrAbsentWhateverTheImagesHold) {
    for (const float a : {0.0F, -0.01F, 1.0F, -3e38F, 3e38F, 1e-45F, kInf, -kInf, kNan})
        for (const float b : {0.0F, -0.01F, 1.0F, -3e38F, 3e38F, kInf, kNan})
            for (const ColorSpace space : {ColorSpace::linear, ColorSpace::display})
                for (const auto& value : measure(flat(11, 11, a, 0, 0, space), flat(11, 11, b, 0, 0, space)))
                    EXPECT_TRUE(std::isfinite(value.value_or(0))) << a << " " << b;
}

TEST_P(EveryMetric, IsTheSameToTheBitForAnyNumberOfThreads) {
    const Image r = noise(67, 257, 1), v = noise(67, 257, 2);
    const auto with_threads = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return measure(r, v);
    };
    const Values one = with_threads(1);
    for (int repeat = 0; repeat < 5; ++repeat) ASSERT_EQ(with_threads(4), one);
}

TEST_P(EveryMetric, GivesTheNumbersItNames) {
    EXPECT_EQ(measure(noise(12, 12, 1), noise(12, 12, 2)).size(), GetParam()->values.size());
    EXPECT_FALSE(GetParam()->values.empty());
    EXPECT_FALSE(GetParam()->summary.empty());
}

// How a reader turns it: 1 more is worse, -1 more is better, 0 it says nothing of the size of the error.
int sense(std::string_view key) {
    if (key == "nonfinite_px" || key.starts_with("flip_exposure")) return 0;
    return key == "psnr_db" || key == "ssim" ? -1 : 1;
}

TEST_P(EveryMetric, GrowsWorseWithAddedNoise) {
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::display}) {
        const Image r = blend(noise(40, 40, 1, space), flat(40, 40, 0.5F, 0.5F, 0.5F, space), 0.5F);
        const Image d = noise(40, 40, 2, space);
        for (size_t i = 0; i < GetParam()->values.size(); ++i) {
            double previous = -std::numeric_limits<double>::infinity();
            for (const float scale : {0.0F, 0.005F, 0.02F, 0.1F, 0.2F}) {
                Image v = r;
                for (size_t k = 0; k < v.rgb.size(); ++k) v.rgb[k] += scale * (d.rgb[k] - 0.5F);
                const auto measured = measure(r, v)[i];
                if (sense(GetParam()->values[i]) == 0 || !measured) continue;
                const double value = *measured * sense(GetParam()->values[i]);
                EXPECT_GT(value, previous) << GetParam()->values[i] << " " << scale;
                previous = value;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Table, EveryMetric, ::testing::ValuesIn(all_metrics().begin(), all_metrics().end()),
                         [](const auto& metric) { return std::string(metric.param->key); });

TEST(Metrics, HaveUniqueKeys) {
    std::set<std::string_view> metrics, values;
    for (const Metric* metric : all_metrics()) EXPECT_TRUE(metrics.insert(metric->key).second) << metric->key;
    for (const std::string_view key : metric_value_keys()) EXPECT_TRUE(values.insert(key).second) << key;
    EXPECT_FALSE(values.contains("identical"));
}

TEST(Metrics, OfSinglePixelsDoNotDependOnTheirOrder) {
    const Image r = noise(64, 40, 1), v = noise(64, 40, 2);
    Image r2 = r, v2 = v;
    for (size_t i = 0; i < r.pixel_count(); ++i) {
        const size_t to = (i * 7 + 3) % r.pixel_count();  // 7 and 2560 have no common factor
        for (size_t c = 0; c < 3; ++c) {
            r2.rgb[3 * to + c] = r.rgb[3 * i + c];
            v2.rgb[3 * to + c] = v.rgb[3 * i + c];
        }
    }
    for (const char* key :
         {"rmse", "psnr_db", "max_abs", "max_rel", "mrse", "rel_p50", "rel_p90", "rel_p99", "rel_p999", "nonfinite_px"})
        EXPECT_NEAR(measure(key, r, v), measure(key, r2, v2), 1e-12 * measure(key, r, v)) << key;
}

TEST(Metrics, ThatDoNotAskWhichIsTheReferenceAreSymmetric) {
    const Image r = noise(30, 40, 1, ColorSpace::display), v = noise(30, 40, 2, ColorSpace::display);
    for (const char* key : {"rmse", "psnr_db", "max_abs", "ssim", "flip_mean", "flip_max"})
        EXPECT_EQ(measure(key, r, v), measure(key, v, r)) << key;
}

// Two pixels of display values: differences 0.5, 0, 0 and 0, -0.25, 0.
const Image kReference = image_of(2, 1, {0.5F, 1, 0, 1, 0.25F, 0}, ColorSpace::display);
const Image kTest = image_of(2, 1, {1, 1, 0, 1, 0, 0}, ColorSpace::display);
// And of linear ones.
const Image kLinearReference = image_of(2, 1, {0.5F, 1, 0, 2, 0.25F, 0});
const Image kLinearTest = image_of(2, 1, {1, 1, 0, 2, 0, 0});

TEST(Metrics, GiveTheNumbersWorkedOutByHand) {
    // (0.25 + 0.0625) / 6 = 0.0520833...; its root is 0.228218.
    EXPECT_NEAR(measure("rmse", kReference, kTest), 0.2282177322938192, 1e-15);
    // 10 log10(1 / 0.0520833) = 10 log10(19.2)
    EXPECT_NEAR(measure("psnr_db", kReference, kTest), 12.8330122870355, 1e-12);
    EXPECT_EQ(measure("max_abs", kReference, kTest), 0.5);
    EXPECT_EQ(measure("max_abs", kLinearReference, kLinearTest), 0.5);
    // ((0.5 / 0.51)^2 + (0.25 / 0.26)^2) / 6
    EXPECT_NEAR(measure("mrse", kLinearReference, kLinearTest), (0.9611687812379854 + 0.9245562130177515) / 6, 1e-12);
    // 0.5 by the pixel's largest channel 1, and 0.25 by 2.
    EXPECT_EQ(measure("max_rel", kLinearReference, kLinearTest), 0.5);
    EXPECT_EQ(measure("rel_p50", kLinearReference, kLinearTest), (0.5 + 0.125) / 2);
    EXPECT_NEAR(measure("rel_p90", kLinearReference, kLinearTest), 0.125 + 0.9 * 0.375, 1e-15);
    EXPECT_EQ(measure("nonfinite_px", kReference, kTest), 0);
}

TEST(Psnr, HasPeakOne) {
    // A constant error of 0.1: 20 dB. Of 1/255, one step of 8 bits: 48.1308 dB.
    const auto grey = [](float v) { return flat(4, 4, v, v, v, ColorSpace::display); };
    EXPECT_NEAR(measure("psnr_db", grey(0.0F), grey(0.1F)), 20.0, 1e-6);
    EXPECT_NEAR(measure("psnr_db", grey(0.5F), grey(0.5F + 1 / 255.0F)), 48.1308, 1e-4);
}

TEST(Mrse, IsTakenOnLinearValues) {
    // Display 0.5 is 0.2140411 linear, 1 is 1: ((1 - 0.2140411) / 0.2240411)^2 = 12.30677.
    const Image r = flat(1, 1, 0.5F, 0.5F, 0.5F, ColorSpace::display);
    const Image v = flat(1, 1, 1, 1, 1, ColorSpace::display);
    EXPECT_NEAR(measure("mrse", r, v), 12.30677, 2e-5);
}

TEST(RelativeError, OfABlackPixelIsByTheDarkestThatCounts) {
    EXPECT_NEAR(
        measure("max_rel", flat(1, 1, 0, 0, 0, ColorSpace::linear), flat(1, 1, 0, 3e-4F, 0, ColorSpace::linear)), 3.0,
        1e-6);
}

TEST(Percentiles, InterpolateBetweenOrderStatistics) {
    // 0, 1, ..., 999 by a reference of 1, in a shuffled order: the fraction f lies at f * 999.
    Image r = flat(40, 25, 1, 1, 1, ColorSpace::linear), v = r;
    for (size_t i = 0; i < 1000; ++i) v.rgb[3 * (i * 7 % 1000)] = 1 + static_cast<float>(i);
    EXPECT_NEAR(measure("rel_p50", r, v), 499.5, 1e-9);
    EXPECT_NEAR(measure("rel_p90", r, v), 899.1, 1e-9);
    EXPECT_NEAR(measure("rel_p99", r, v), 989.01, 1e-9);
    EXPECT_NEAR(measure("rel_p999", r, v), 998.001, 1e-9);
    EXPECT_EQ(measure("max_rel", r, v), 999);
}

TEST(Metrics, LeaveNonFinitePixelsOutAndCountThem) {
    for (const auto& [reference, test] : {std::pair(kReference, kTest), std::pair(kLinearReference, kLinearTest)}) {
        Image r = reference, v = test;
        const auto append = [](Image& image, std::vector<float> pixel) {
            image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.end());
        };
        append(r, {1, 1, 1}), append(v, {1, kNan, 9});
        append(r, {kInf, 0, 0}), append(v, {kInf, 0, 7});
        append(r, {0, 0, -kInf}), append(v, {5, 5, 5});
        r.width = v.width = 5;
        for (const char* key : {"rmse", "psnr_db", "max_abs", "max_rel", "mrse", "rel_p50", "rel_p90", "rel_p999"})
            EXPECT_EQ(measure(key, r, v), measure(key, reference, test)) << key;
        EXPECT_EQ(measure("nonfinite_px", r, v), 3);
    }
}

TEST(Metrics, AreAbsentWithoutAFinitePixel) {
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::display}) {
        const Image nothing = flat(16, 16, kNan, 0, 0, space);
        const ImageError error = measure_error(image_pair(nothing, nothing));
        for (const std::string_view key : metric_value_keys()) {
            if (sense(key) == 0) continue;
            EXPECT_FALSE(error.value(key)) << key;
        }
        EXPECT_EQ(error.value("nonfinite_px"), 256);
    }
}

}  // namespace
}  // namespace lightsweep
