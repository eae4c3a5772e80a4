// The errors of a cell on numbers worked out by hand.
#include "bench/measure/cell_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image image_of(std::vector<float> rgb, ColorSpace space = ColorSpace::display) {
    Image image(static_cast<int>(rgb.size() / 3), 1, space);
    image.rgb = std::move(rgb);
    return image;
}

TEST(PackingShare, SplitsTheSquaredError) {
    const Image reference = image_of({0, 0, 0});
    // The control is off by 1 in red, the test by that and 3 in green: 9 of 10 squared units are the packing's.
    EXPECT_DOUBLE_EQ(*packing_share(reference, image_of({1, 0, 0}), image_of({1, 3, 0})), 0.9);
    EXPECT_DOUBLE_EQ(*packing_share(reference, image_of({1, 0, 0}), image_of({1, 0, 0})), 0.0);
    EXPECT_DOUBLE_EQ(*packing_share(reference, image_of({0, 0, 0}), image_of({1, 3, 0})), 1.0);
    EXPECT_FALSE(packing_share(reference, image_of({1, 0, 0}), reference)) << "no error, no share of it";
}

TEST(MeanIntervalOfAMap, IsStudentsOverSixtyFourRegions) {
    // Half of the regions hold 0, half 1: mean 1/2, and a standard error of sqrt(64 / 4 / 63 / 64) = 1 / sqrt(252).
    FlipMap map{.width = 16, .height = 16, .error = std::vector<float>(256, 0.0F), .exposures = {}};
    for (size_t i = 128; i < 256; ++i) map.error[i] = 1.0F;
    const auto interval = mean_interval(map);
    ASSERT_TRUE(interval);
    EXPECT_NEAR(interval->low, 0.5 - 1.9983 / std::sqrt(252.0), 1e-4);
    EXPECT_NEAR(interval->high, 0.5 + 1.9983 / std::sqrt(252.0), 1e-4);
}

TEST(MeanIntervalOfAMap, IsAPointWhereEveryRegionIsAlike) {
    const FlipMap flat{.width = 24, .height = 8, .error = std::vector<float>(192, 0.25F), .exposures = {}};
    EXPECT_DOUBLE_EQ(mean_interval(flat)->low, 0.25);
    EXPECT_DOUBLE_EQ(mean_interval(flat)->high, 0.25);
    EXPECT_FALSE(mean_interval({.width = 7, .height = 80, .error = std::vector<float>(560), .exposures = {}}));
}

TEST(RelativeErrorOfAPicture, IsByTheLargestChannels) {
    std::vector<ReferenceSurface> surfaces(5);
    for (auto& s : surfaces) s.covered = true;
    surfaces[4].covered = false;  // its error does not count
    const Image reference = image_of({1, 2, 4, 1, 1, 1, 2, 0, 0, 0, 0, 0, 1, 1, 1}, ColorSpace::linear);
    const Image test = image_of({1, 2, 5, 1, 1, 1, 1, 0, 0, 9, 9, 9, 7, 7, 7}, ColorSpace::linear);
    const RelativeError error = relative_error(reference, test, surfaces);
    EXPECT_DOUBLE_EQ(error.median, 0.25) << "of 1/4, 0, 1/2";
    EXPECT_DOUBLE_EQ(error.max, 0.5);
    EXPECT_EQ(error.above_1e4_px, 2);
}

TEST(RelativeErrorOfAPicture, CountsWhatIsNotFinite) {
    const std::vector<ReferenceSurface> surfaces(2, {.covered = true});
    const RelativeError error = relative_error(image_of({1, 1, 1, 1, 1, 1}), image_of({1, kNan, 1, 1, 1, 1}), surfaces);
    EXPECT_EQ(error.above_1e4_px, 1);
    EXPECT_EQ(error.max, 0.0);
}

ReferenceSurface truth() {
    return {.position = {0, 3, -4},
            .normal = {0, 0, 1},
            .base_color = {0.5, 0.25, 0.125},
            .specular = {0.5, 0.5, 0.5},
            .emissive = {8, 0, 0},
            .roughness = 0.5,
            .metallic = 1.0,
            .model = ShadingModel::ggx,
            .covered = true};
}

DecodedSurface decoded_exactly(const ReferenceSurface& s) {
    return {.position = s.position,
            .normal = s.normal,
            .base_color = s.base_color,
            .specular = s.specular,
            .emissive = s.emissive,
            .roughness = static_cast<float>(s.roughness),
            .metallic = static_cast<float>(s.metallic),
            .covered = s.covered};
}

TEST(LayoutErrorOf, EachFieldInItsOwnUnit) {
    const std::vector<ReferenceSurface> surfaces(1, truth());
    DecodedSurface d = decoded_exactly(truth());
    d.position = {0, 3, -4.5};  // 0.5 of 5
    d.normal = {1, 0, 1};       // of any length: 45 degrees
    d.base_color = {0.5, 0.25, 0.25};
    d.specular = {0.25, 0.5, 0.5};
    d.emissive = {6, 0, 0};  // 2 of 8
    d.roughness = 0.25F;
    d.metallic = 0.5F;
    const SceneNeeds all{.roughness = true, .metallic = true, .specular = true, .emissive = true};
    const LayoutError error = layout_error(surfaces, std::vector<DecodedSurface>{d}, all);
    std::map<std::string, std::pair<std::string, double>> found;
    for (const auto& field : error.fields) {
        EXPECT_EQ(field.mean, field.max);
        EXPECT_EQ(field.mean, field.p99);
        found[field.field] = {field.unit, std::round(field.mean * 1e6) / 1e6};
    }
    const std::map<std::string, std::pair<std::string, double>> expected = {
        {"normal", {"deg", 45}},     {"position", {"rel", 0.1}},   {"base_color", {"abs", 0.125}},
        {"specular", {"abs", 0.25}}, {"roughness", {"abs", 0.25}}, {"metallic", {"abs", 0.5}},
        {"emissive", {"rel", 0.25}}};
    EXPECT_EQ(found, expected);
    EXPECT_EQ(layout_error(surfaces, std::vector<DecodedSurface>{d}, {}).fields.size(), 3U) << "what is not needed";
}

TEST(LayoutErrorOf, LostPixelsAreCountedAndLeftOut) {
    std::vector<ReferenceSurface> surfaces(5, truth());
    surfaces[1].covered = false;
    surfaces[4].covered = false;
    std::vector<DecodedSurface> decoded(5, decoded_exactly(truth()));
    decoded[2].covered = false;  // 1: only the layout covers it, 2: only the reference
    decoded[3].normal.y = kNan;
    decoded[4].covered = false;  // background in both
    const LayoutError error = layout_error(surfaces, decoded, {});
    EXPECT_EQ(error.lost_px, 3);
    ASSERT_FALSE(error.fields.empty());
    for (const auto& field : error.fields) EXPECT_EQ(field.max, 0.0) << field.field;
}

}  // namespace
}  // namespace lightsweep
