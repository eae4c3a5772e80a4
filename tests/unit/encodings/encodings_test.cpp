// What must hold for what `lightsweep encodings` sends and how it tells the error, without GL.
#include "bench/encodings/field_kind.h"
#include "bench/encodings/variant.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"
#include "renderer/frame/frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

namespace lightsweep {
namespace {

using testing::HasSubstr;

constexpr int kSide = 256;

Variant variant(const std::string& field, const std::string& name) {
    for (auto& v : shipped_variants()) {
        if (v.field == field && v.name == name) return v;
    }
    throw std::runtime_error("no variant " + field + " " + name);
}

double share(const std::vector<glm::vec4>& values, const auto& holds) {
    return static_cast<double>(std::count_if(values.begin(), values.end(), holds)) / static_cast<double>(values.size());
}

TEST(Variants, BitsAreInTheirNames) {
    for (const auto& v : shipped_variants()) {
        int sum = 0;
        size_t numbers = 0;
        for (const auto& word : split(v.name, '_')) {
            if (word.find_first_not_of("0123456789") != std::string::npos) continue;
            sum += std::stoi(word);
            ++numbers;
        }
        if (numbers > 0) {
            EXPECT_EQ(v.bits(), sum) << v.field << " " << v.name;
        }
    }
    EXPECT_EQ(variant("base_color", "rgb9e5").bits(), 32);
    EXPECT_EQ(variant("depth", "d24_standard").bits(), 24);
}

TEST(Variants, CoverEveryFieldAndEveryDepth) {
    std::set<std::string> fields, depths;
    for (const auto& v : shipped_variants()) {
        fields.insert(v.field);
        if (v.is_depth())
            depths.insert(std::string(gl::info(v.layout.depth).name) +
                          std::to_string(static_cast<int>(v.layout.convention)) +
                          std::to_string(static_cast<int>(v.clip)));
    }
    EXPECT_EQ(depths.size(), 3U * 2U * 2U);
    for (const auto& field : field_names()) EXPECT_TRUE(fields.contains(field)) << field;
}

TEST(Variants, MistakesAreNamed) {
    const auto error_of = [](const std::string& rows) {
        const auto file = std::filesystem::path(testing::TempDir()) / "variants.json";
        write_file_atomically(file, R"({"variants": [)" + rows + "]}");
        try {
            load_variants(file);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const std::string good = R"({"field": "roughness", "name": "a", "format": "R8", "encoding": "linear", "in": "r"})";
    EXPECT_EQ(error_of(good), "no error");
    EXPECT_THAT(error_of(good + "," + good), HasSubstr("/variants/1/name"));
    EXPECT_THAT(
        error_of(R"({"field": "depth", "name": "a", "format": "R8", "convention": "standard", "clip": "zero_to_one"})"),
        HasSubstr("not a depth format"));
    EXPECT_THAT(
        error_of(R"({"field": "depth", "name": "a", "format": "D16", "convention": "standard", "clip": "one"})"),
        HasSubstr("minus_one_to_one"));
    EXPECT_THAT(error_of(R"({"field": "roughnes", "name": "a", "format": "R8", "encoding": "linear", "in": "r"})"),
                HasSubstr("did you mean 'roughness'"));
    EXPECT_THAT(error_of(R"({"field": "roughness", "name": "a", "format": "D16", "encoding": "linear", "in": "r"})"),
                HasSubstr("/variants/0/format"));
}

TEST(Samples, AreTheSameEachTime) {
    const Variant v = variant("normal", "oct_8_8");
    EXPECT_EQ(make_samples(v, kSide, kSide), make_samples(v, kSide, kSide));
}

TEST(Samples, NormalsAreUniformOnTheSphere) {
    const auto values = make_samples(variant("normal", "oct_8_8"), kSide, kSide);
    for (const auto& v : values) ASSERT_NEAR(glm::length(glm::dvec3(v)), 1.0, 1e-6);
    // A cap's share of the sphere is its height's: (1 - 0.6) / 2, about whichever axis. Five standard errors: 0.008.
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(share(values, [&](const glm::vec4& v) { return v[axis] > 0.6F; }), 0.2, 0.008) << axis;
        EXPECT_NEAR(share(values, [&](const glm::vec4& v) { return v[axis] < -0.6F; }), 0.2, 0.008) << axis;
    }
}

TEST(Samples, HemispheresFaceTheEyeOfTheirPixel) {
    const Variant v = variant("normal", "hemi_oct_8_8");
    const auto values = make_samples(v, kSide, kSide);
    // The ray of a pixel: any place that the camera puts there.
    const glm::dmat4 world = glm::inverse(camera_projection(probe_camera(v), kSide, kSide, DepthConvention::reversed));
    size_t above = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const double x = static_cast<double>(i % kSide) + 0.5, y = static_cast<double>(i / kSide) + 0.5;
        const glm::dvec4 place = world * glm::dvec4(2.0 * x / kSide - 1.0, 2.0 * y / kSide - 1.0, 0.5, 1.0);
        const double towards = -glm::dot(glm::dvec3(values[i]), glm::normalize(glm::dvec3(place) / place.w));
        ASSERT_GE(towards, -1e-6) << i;
        above += towards > 0.6 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(above) / static_cast<double>(values.size()), 0.4, 0.01);
    EXPECT_EQ(sample_domain(v), "hemisphere");
}

TEST(Samples, DistancesAreLogUniform) {
    for (const auto& [field, name] : {std::pair{"depth", "d16_standard"}, {"position", "half_16_16_16"}}) {
        const auto values = make_samples(variant(field, name), kSide, kSide);
        const auto distance = [](const glm::vec4& v) { return static_cast<double>(glm::length(glm::vec3(v))); };
        for (const auto& v : values) {
            ASSERT_GE(distance(v), kNearDistance * (1.0 - 1e-6));
            ASSERT_LE(distance(v), kFarDistance * (1.0 + 1e-6));
        }
        EXPECT_NEAR(share(values, [&](const glm::vec4& v) { return distance(v) < 1.0; }), 0.25, 0.01) << field;
        EXPECT_NEAR(share(values, [&](const glm::vec4& v) { return distance(v) < 100.0; }), 0.75, 0.01) << field;
    }
}

TEST(Samples, NeighboursBlendInPatchesOfColorsThatAllDiffer) {
    const auto values = make_samples(variant("base_color", "ycocg_8_8"), kSide, kSide);
    const auto at = [&](int x, int y) { return glm::vec3(values[static_cast<size_t>(y * kSide + x)]); };
    std::set<std::array<float, 3>> different;
    for (const auto& v : values) different.insert({v.r, v.g, v.b});
    EXPECT_EQ(different.size(), values.size());
    // Along a row of a patch colours run straight, by no more than the whole range over its width. Across its edge most
    // jump: two independent colours.
    int jumps = 0;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x + 1 < kSide; ++x) {
            const glm::vec3 step = glm::abs(at(x + 1, y) - at(x, y));
            const float largest = std::max({step.r, step.g, step.b});
            if ((x + 1) % kPatch != 0) {
                ASSERT_LE(largest, 1.0F / kPatch + 1e-6F) << x << " " << y;
            } else {
                jumps += largest > 2.0F / kPatch ? 1 : 0;
            }
        }
    }
    EXPECT_GT(jumps, kSide * (kSide / kPatch - 1) * 9 / 10);
}

TEST(Errors, AreWhatTheyAreByHand) {
    const auto error = [](const char* field, const glm::vec4& sent, const glm::vec4& back) {
        return summarize_errors(field_kind(field), std::vector{sent}, std::vector{back}).max;
    };
    EXPECT_NEAR(error("normal", {1, 0, 0, 0}, {0, 1, 0, 0}), 90.0, 1e-12);
    EXPECT_NEAR(error("normal", {0, 0, 1, 0}, {0, 0, -1, 0}), 180.0, 1e-12);
    EXPECT_NEAR(error("normal", {0, 0, 1, 0}, {1e-5F, 0, 1, 0}), 1e-5 * 180.0 / 3.14159265358979, 1e-9)
        << "no cancellation";
    EXPECT_NEAR(error("depth", {8, 0, 0, 0}, {10, 0, 0, 0}), 0.25, 1e-12);
    EXPECT_NEAR(error("position", {3, 4, 0, 0}, {3, 4, 1, 0}), 0.2, 1e-12);
    EXPECT_NEAR(error("base_color", {0.5F, 0.5F, 0.5F, 0}, {0.5F, 0.25F, 1.0F, 0}), 0.5, 1e-12);
    EXPECT_NEAR(error("emissive", {8, 4, 2, 0}, {8, 4, 3, 0}), 0.125, 1e-12) << "of the largest channel";
    EXPECT_NEAR(error("model", {2, 0, 0, 0}, {1, 0, 0, 0}), 1.0, 1e-12);
}

TEST(Errors, AreSummarised) {
    std::vector<glm::vec4> sent(1000, glm::vec4(0.0F)), back;
    for (int i = 0; i < 1000; ++i) back.emplace_back(static_cast<float>(i), 0.0F, 0.0F, 0.0F);
    const auto summary = summarize_errors(field_kind("roughness"), sent, back);
    EXPECT_NEAR(summary.mean, 499.5, 1e-9);
    EXPECT_NEAR(summary.p99, 0.99 * 999.0, 1e-9);
    EXPECT_EQ(summary.max, 999.0);
    EXPECT_EQ(summary.compared, 1000U);
    back[17].x = std::numeric_limits<float>::quiet_NaN();
    const auto broken = summarize_errors(field_kind("roughness"), sent, back);
    EXPECT_FALSE(std::isfinite(broken.max)) << "never skipped";
    EXPECT_EQ(broken.compared, 999U);
    // A value of three channels counts once.
    back[18].z = std::numeric_limits<float>::infinity();
    EXPECT_EQ(summarize_errors(field_kind("base_color"), sent, back).compared, 998U);
}

}  // namespace
}  // namespace lightsweep
