// What must hold for the encodings through the GPU: the errors that theory and published tables give, and what their
// authors promise. Expected errors are computed here, in double precision and apart from the shaders' text.
#include "bench/encodings/measure.h"
#include "tests/gl/round_trips.h"

#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace lightsweep {
namespace {

// --- An octahedral map in double precision, from its geometry: the sphere is projected onto the octahedron, the back
// --- half's triangles are folded out along the edges |x| + |y| = 1.

glm::dvec2 onto_square(const glm::dvec3& n) {
    const glm::dvec3 o = n / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (o.z > 0.0) return {o.x, o.y};
    return {std::copysign(1.0 - std::abs(o.y), o.x), std::copysign(1.0 - std::abs(o.x), o.y)};
}

glm::dvec3 from_square(const glm::dvec2& e) {
    const double height = 1.0 - std::abs(e.x) - std::abs(e.y);
    glm::dvec3 o(e, height);
    if (height < 0.0) {
        o.x = std::copysign(1.0 - std::abs(e.y), e.x);
        o.y = std::copysign(1.0 - std::abs(e.x), e.y);
    }
    return glm::normalize(o);
}

double rounded(double v, double steps) { return std::round(v * steps) / steps; }

double mean_of(const std::vector<glm::vec4>& values, const std::function<double(const glm::dvec3&)>& error) {
    double sum = 0.0;
    for (const auto& v : values) sum += error(glm::dvec3(v));
    return sum / static_cast<double>(values.size());
}

TEST(Encodings, NormalsMatchThePublishedTables) {
    // Cigolle et al. 2014, JCGT 3(2), table 1: degrees.
    const struct {
        const char* name;
        double mean, max;
    } published[] = {{"oct_8_8", 0.33709, 0.94424},
                     {"snorm_8_8_8", 0.17015, 0.38588},
                     {"oct_10_10", 0.08380, 0.23467},
                     {"oct_12_12", 0.02091, 0.05874}};
    for (const auto& row : published) {
        const auto error = errors("normal", row.name);
        EXPECT_NEAR(error.mean, row.mean, 0.01 * row.mean) << row.name;
        EXPECT_NEAR(error.max, row.max, 0.03 * row.max) << row.name << ": a maximum over samples";
    }
}

TEST(Encodings, OctahedralMeansMatchDoublePrecision) {
    const std::map<int, double> steps = {{8, 127.0}, {10, 511.0}, {12, 2047.0}, {16, 32767.0}};
    for (const auto& [bits, n] : steps) {
        const std::string size = "_" + std::to_string(bits) + "_" + std::to_string(bits);
        const auto& values = sent("normal", "oct" + size).values;
        const double plain = mean_of(values, [n = n](const glm::dvec3& v) {
            const glm::dvec2 e = onto_square(v);
            return angle_deg(v, from_square({rounded(e.x, n), rounded(e.y, n)}));
        });
        EXPECT_NEAR(errors("normal", "oct" + size).mean, plain, 0.01 * plain) << size;
        const double precise = mean_of(values, [n = n](const glm::dvec3& v) {
            const glm::dvec2 low = glm::floor(onto_square(v) * n);
            double best = 180.0;
            for (int i = 0; i < 4; ++i) {
                const glm::dvec2 e = (low + glm::dvec2(i % 2, i / 2)) / n;
                if (std::max(std::abs(e.x), std::abs(e.y)) <= 1.0) best = std::min(best, angle_deg(v, from_square(e)));
            }
            return best;
        });
        EXPECT_NEAR(errors("normal", "oct_precise" + size).mean, precise, 0.01 * precise) << size;
    }
}

TEST(Encodings, FixedPointMeansMatchTheory) {
    // A uniform value is off by a quarter of a step in the mean and by half a step at most, in each channel.
    const struct {
        const char *field, *name;
        double steps;
    } linear[] = {{"base_color", "rgb_8_8_8", 255},
                  {"roughness", "linear_8", 255},
                  {"roughness", "linear_6", 63},
                  {"metallic", "linear_8", 255},
                  {"metallic", "linear_4", 15}};
    for (const auto& row : linear) {
        const auto error = errors(row.field, row.name);
        EXPECT_NEAR(error.mean * row.steps, 0.25, 0.0025) << row.field << " " << row.name;
        EXPECT_NEAR(error.max * row.steps, 0.5, 0.005) << row.field << " " << row.name;
    }
    // In 10 bits llvmpipe stores floor(1024 c) in place of round(1023 c): right in the middle, a whole step off at the
    // ends, which is a third of a step in the mean.
    const auto ten = errors("base_color", "rgb_10_10_10");
    EXPECT_GE(ten.mean * 1023.0, 0.2475);
    EXPECT_LE(ten.mean * 1023.0, 0.336);
    EXPECT_LE(ten.max * 1023.0, 1.005);
    // c = e^2 with c uniform: |dc| = 2 e |de|, and the mean of e = sqrt(c) is 2/3: 4/3 of a quarter of a step.
    for (const auto& [field, name, steps] : {std::tuple{"base_color", "gamma2_8_8_8", 255.0},
                                             {"base_color", "gamma2_7_7_7", 127.0},
                                             {"roughness", "sqrt_8", 255.0}}) {
        EXPECT_NEAR(errors(field, name).mean * steps, 1.0 / 3.0, 0.005) << name;
    }
    // e = log2(1 + 31 r) / 5, so |dr| = 5 ln 2 (1 + 31 r) / 31 |de|, and the mean of 1 + 31 r is 16.5.
    EXPECT_NEAR(errors("roughness", "log2_8").mean * 255.0, 0.25 * 5.0 * std::log(2.0) * 16.5 / 31.0, 0.006);
    // IEC 61966-2-1's slope dc/de over c = e^2.4-ish, by numeric integration over uniform c.
    double slope = 0.0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
        const double c = (i + 0.5) / kSteps;
        const double e = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
        slope += (c <= 0.0031308 ? 1.0 / 12.92 : 2.4 / 1.055 * std::pow((e + 0.055) / 1.055, 1.4)) / kSteps;
    }
    // The hardware's own conversion may be approximate (Direct3D asks for 0.6 steps; llvmpipe is off by up to 0.9).
    const double srgb = errors("base_color", "srgb_8_8_8").mean * 255.0 / (0.25 * slope);
    EXPECT_GE(srgb, 0.99);
    EXPECT_LE(srgb, 1.2);
}

TEST(Encodings, ErrorHalvesWithEachBit) {
    for (const char* encoding : {"oct", "oct_precise", "hemi_oct", "spheremap"}) {
        const auto mean = [&](int bits) {
            const std::string b = std::to_string(bits);
            return errors("normal", std::string(encoding) + "_" + b + "_" + b).mean;
        };
        EXPECT_NEAR(mean(8) / mean(10), 511.0 / 127.0, 0.06) << encoding;
        EXPECT_NEAR(mean(10) / mean(12), 2047.0 / 511.0, 0.06) << encoding;
        EXPECT_NEAR(mean(12) / mean(16), 32767.0 / 2047.0, 0.25) << encoding;
    }
}

TEST(Encodings, SearchingIsNeverWorse) {
    for (const auto& [searched, plain] : {std::pair{"oct_precise_8_8", "oct_8_8"},
                                          {"oct_precise_10_10", "oct_10_10"},
                                          {"oct_precise_12_12", "oct_12_12"},
                                          {"oct_precise_16_16", "oct_16_16"},
                                          {"best_fit_8_8_8", "snorm_8_8_8"},
                                          {"best_fit_10_10_10", "unorm_10_10_10"}}) {
        const Sent &best = sent("normal", searched), &usual = sent("normal", plain);
        size_t worse = 0;
        for (size_t i = 0; i < best.values.size(); ++i) {
            const glm::dvec3 v(best.values[i]);
            // 1e-5 degrees: what 32-bit floats tell apart.
            worse += angle_deg(v, glm::dvec3(best.back[i])) > angle_deg(v, glm::dvec3(usual.back[i])) + 1e-5 ? 1 : 0;
        }
        EXPECT_EQ(worse, 0U) << searched << " against " << plain << " of " << best.values.size();
        EXPECT_LT(errors("normal", searched).mean, 0.95 * errors("normal", plain).mean);
    }
}

TEST(Encodings, BestFitFindsTheBestLength) {
    // Against a search of every length in small steps, in double precision: nothing between is better.
    const Sent& s = sent("normal", "best_fit_8_8_8");
    for (size_t i = 0; i < s.values.size(); i += 1021) {
        const glm::dvec3 v(s.values[i]);
        const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        double best = 180.0;
        for (double length = 1.0; length <= 127.0; length += 0.01)
            best = std::min(best, angle_deg(v, glm::round(v / largest * length)));
        EXPECT_LE(angle_deg(v, glm::dvec3(s.back[i])), best + 1e-5) << v.x << " " << v.y << " " << v.z;
    }
}

TEST(Encodings, DecodedNormalsAreOfUnitLength) {
    for (const Variant& v : shipped_variants()) {
        if (v.field != "normal") continue;
        double worst = 0.0;
        for (const auto& n : sent("normal", v.name).back)
            worst = std::max(worst, std::abs(glm::length(glm::dvec3(n)) - 1.0));
        EXPECT_LT(worst, 5e-7) << v.name;
    }
}

TEST(Encodings, FloatAndIdAreExact) {
    for (const auto& [field, name] : {std::pair{"position", "float_32_32_32"},
                                      {"base_color", "float_32_32_32"},
                                      {"model", "id_8"},
                                      {"model", "id_2"}}) {
        EXPECT_EQ(errors(field, name).max, 0.0) << field << " " << name;
    }
    EXPECT_LT(errors("normal", "float_32_32_32").max, 1e-5) << "renormalised, so not bit by bit";
}

TEST(Encodings, YcocgErrsAtEdges) {
    // What is worse than 99 of 100 values lies between two patches: within them a neighbour's chroma is nearly one's
    // own.
    for (const char* name : {"ycocg_8_8", "ycocg_7_6"}) {
        const Sent& s = sent("base_color", name);
        const auto at_edge = [](int i) {
            return (i % kPatch == 0 && i > 0) || (i % kPatch == kPatch - 1 && i < kSide - 1);
        };
        double worst_within = 0.0;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                if (at_edge(x) || at_edge(y)) continue;
                const auto i = static_cast<size_t>(y * kSide + x);
                const glm::dvec3 off = glm::abs(glm::dvec3(s.back[i] - s.values[i]));
                worst_within = std::max({worst_within, off.r, off.g, off.b});
            }
        }
        EXPECT_LT(worst_within, errors("base_color", name).p99) << name;
        EXPECT_GT(errors("base_color", name).max, 10.0 * worst_within) << name;
    }
}

// --- Depth. z is a hyperbola of depth: a step d of depth is z^2 (f - n) / (f n) d of distance.

double relative_step(double z, double depth_step) {
    return z * (kFarDistance - kNearDistance) / (kFarDistance * kNearDistance) * depth_step;
}

TEST(Encodings, DepthErrorIsItsSpacing) {
    // Where depth is near 1 (standard), or without clip control, z / w passes through 32-bit floats there: their step
    // of 2^-24 comes on top, once for z / w itself and once for the viewport.
    const std::map<std::string, double> steps = {{"d16_standard", 1.0 / 65535.0},
                                                 {"d16_standard_no_clip_control", 1.0 / 65535.0},
                                                 {"d16_reversed", 1.0 / 65535.0},
                                                 {"d16_reversed_no_clip_control", 1.0 / 65535.0},
                                                 {"d24_reversed", 0x1p-24},
                                                 {"d24_reversed_no_clip_control", 0x1p-24 + 0x1p-24},
                                                 {"d24_standard", 0x1p-24 + 0x1p-23},
                                                 {"d24_standard_no_clip_control", 0x1p-24 + 0x1p-23},
                                                 {"d32f_standard", 0x1p-24 + 0x1p-23},
                                                 {"d32f_standard_no_clip_control", 0x1p-23},
                                                 {"d32f_reversed_no_clip_control", 0x1p-24}};
    for (const auto& [name, step] : steps) {
        const Sent& s = sent("depth", name);
        double worst = 0.0;
        for (size_t i = 0; i < s.values.size(); ++i) {
            const double z = static_cast<double>(s.values[i].x), back = static_cast<double>(s.back[i].x);
            worst = std::max(worst, std::abs(back - z) / z / (relative_step(z, step) + 2e-7));
        }
        // Rounding to nearest leaves half a step; truncating a whole one.
        EXPECT_GE(worst, 0.4) << name;
        EXPECT_LE(worst, 2.0) << name;
    }
    // Reversed float: a constant share of the distance, 2^-24 to 2^-23, whatever the distance.
    EXPECT_LE(errors("depth", "d32f_reversed").max, 2.0 * 0x1p-23);
    EXPECT_GE(errors("depth", "d32f_reversed").max, 0.5 * 0x1p-24);
}

TEST(Encodings, ReversedFloatDepthNeedsClipControl) {
    const double with = errors("depth", "d32f_reversed").mean,
                 without = errors("depth", "d32f_reversed_no_clip_control").mean;
    EXPECT_GT(without, 100.0 * with);
    const double standard = errors("depth", "d32f_standard").mean;
    EXPECT_GT(standard, 100.0 * with);
    EXPECT_NEAR(std::log2(without / standard), 0.0, 2.0) << "without it, reversing gains next to nothing";
}

// --- The command's own measuring.

TEST(Encodings, MeasuringGivesOneResultForEachVariant) {
    std::vector<Variant> some = {variant("roughness", "linear_8"), variant("model", "id_2"),
                                 variant("roughness", "sqrt_8")};
    const auto results = measure_encodings(some, 1);
    ASSERT_EQ(results.size(), some.size());
    for (size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(results[i].name, some[i].name);
        EXPECT_EQ(results[i].error.compared, size_t{1} << 20);
        for (const Interval& time : {results[i].encode_ns_per_px, results[i].decode_ns_per_px}) {
            EXPECT_GT(time.estimate, 0.0);
            EXPECT_FALSE(time.low || time.high) << "one round has no spread";
        }
    }
    EXPECT_EQ(results[0].bits, 8);
    EXPECT_EQ(results[1].bits, 2);
    EXPECT_NEAR(results[0].error.mean, 0.25 / 255.0, 0.01 * 0.25 / 255.0);
}

}  // namespace
}  // namespace lightsweep
