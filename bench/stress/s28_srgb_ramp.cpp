// S28: the 256 greys of sRGB through textures, base colours of layouts and the display's curve: each must come back as
// itself. Encoded twice, never, or in the wrong range, they do not.
#include "bench/encodings/round_trip.h"
#include "bench/measure/rounding_probe.h"
#include "bench/stress/case.h"
#include "bench/stress/judge.h"
#include "bench/stress/rounding_law.h"
#include "bench/stress/shader_call.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace lightsweep {
namespace {

constexpr std::string_view kThroughAxis = "through";
constexpr std::string_view kField = "base_color";
constexpr const char *kTexture = "texture", *kSrgbEncode = "srgb_encode", *kToneMap = "tone_map";
constexpr int kSide = 16, kLevels = kSide * kSide;
constexpr double kEndBound = 1e-3;  // steps; black and white come back as they are but for 32-bit arithmetic

// IEC 61966-2-1, in double precision, from and to steps of 8 bits.
double linear_of(double level) {
    const double v = level / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double level_of(double linear) {
    const double v = std::max(linear, 0.0);
    return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
}

// The radiance that the ACES fit of Narkowicz (2015) shows as `linear`: the positive root of
// x (2.51 x + 0.03) = linear (x (2.43 x + 0.59) + 0.14).
double radiance_shown_as(double linear) {
    const double a = 2.51 - 2.43 * linear, b = 0.03 - 0.59 * linear, c = -0.14 * linear;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

// What came back of each level, in each channel, as levels.
using Ramp = std::array<glm::dvec3, kLevels>;

Ramp through_shader(const std::string& call, double (*input_of)(double linear)) {
    std::vector<ShaderInput> inputs;
    for (int i = 0; i < kLevels; ++i) inputs.push_back({.a = glm::vec4(glm::vec3(input_of(linear_of(i))), 1.0F)});
    const auto results = ShaderCall({"lib/display.glsl"}, "result = vec4(" + call + "(a.rgb), 1.0);")(inputs);
    Ramp ramp;
    for (size_t i = 0; i < ramp.size(); ++i) ramp[i] = 255.0 * glm::dvec3(results[i]);
    return ramp;
}

// One texel for each pixel.
Ramp through_texture(Workbench& bench) {
    Texture texture{.name = "ramp", .width = kSide, .height = kSide, .srgb = true, .rgba = {}};
    for (int i = 0; i < kLevels; ++i) {
        const auto level = static_cast<uint8_t>(i);
        texture.rgba.insert(texture.rgba.end(), {level, level, level, 255});
    }
    constexpr double kDistance = 2.0;
    Scene scene = facing_plane({.name = "plane", .model = ShadingModel::lambert, .base_color_texture = 0},
                               2.0 * kDistance * std::tan(glm::radians(30.0)), kDistance);
    scene.textures.push_back(std::move(texture));
    const StressArm arm({{std::string(kPathAxis), "deferred"}});
    const auto surfaces = Drawing(bench, arm, std::move(scene), kSide, kSide).decoded();
    Ramp ramp;
    for (size_t i = 0; i < ramp.size(); ++i) {
        for (int c = 0; c < 3; ++c) ramp[i][c] = level_of(surfaces[i].base_color[c]);
    }
    return ramp;
}

Ramp through_encoding(const Variant& variant) {
    std::vector<glm::vec4> greys;
    for (int i = 0; i < kLevels; ++i) greys.emplace_back(glm::vec3(static_cast<float>(linear_of(i))), 0.0F);
    const auto back = round_trip(variant, greys, kSide, kSide);
    Ramp ramp;
    for (size_t i = 0; i < ramp.size(); ++i) {
        for (int c = 0; c < 3; ++c) ramp[i][c] = level_of(back[i][c]);
    }
    return ramp;
}

// What rounding loses of a step: half of it; all, where the device truncates. Of bits the shader rounds.
double lost_share(gl::Format format) {
    if (gl::info(format).kind == gl::FormatKind::uint) return 0.5;
    return probe_rounding(format).write == Rounding::truncate ? 1.0 : 0.5;
}

// What the encoding's own step at a level may lose, in levels. `share`: of the step.
double step_error(const Variant& variant, int level, double share) {
    const gl::Format format = variant.layout.targets.front().format;
    if (format == gl::Format::SRGB8_A8) return share;
    const double linear = linear_of(level);
    const auto away = [&](const auto& moved) {
        return std::max(std::abs(level_of(moved(1.0)) - level), std::abs(level_of(moved(-1.0)) - level));
    };
    if (const auto grid = channel_grid(format, variant.stored(), 0)) {
        const std::string& encoding = variant.stored().encoding.key;
        const bool roots = encoding == "gamma2" || encoding == "ycocg";
        return away([&](double sign) {
            const double encoded = std::max((roots ? std::sqrt(linear) : linear) + sign * share * grid->step, 0.0);
            return roots ? encoded * encoded : encoded;
        });
    }
    // Floats from 2^-14 on. Nine shared bits are at least eight of the largest channel's own.
    const bool floats = gl::info(format).kind == gl::FormatKind::floating;
    const int bits = floats ? coarsest_channel(format).mantissa_bits : 8;
    const double lost = share * std::ldexp(std::max(linear, 0x1p-14), -bits);
    return away([&](double sign) { return linear + sign * lost; });
}

StressMeasurement judge_ramp(const Ramp& ramp, const Variant* variant) {
    StressMeasurement worst;
    double worst_excess = -1.0;
    const double share = variant != nullptr ? lost_share(variant->layout.targets.front().format) : 0.5;
    for (int i = 0; i < kLevels; ++i) {
        StressMeasurement found{.where = fmt::format("level {}", i)};
        const glm::dvec3 back = ramp[static_cast<size_t>(i)];
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(back[c])) {
                found.error = std::max(found.error, std::abs(back[c] - i));
            } else {
                ++found.non_finite;
            }
        }
        double allowed = 0.5;
        if (i == 0 || i == kLevels - 1) {
            allowed = kEndBound;
            found.bound = kEndBound;
        } else if (variant != nullptr) {
            found.law = step_error(*variant, i, share);
            allowed = std::max(allowed, kLawSlack * *found.law);
        }
        // Failures first, then the largest error.
        const double excess = found.non_finite > 0 || found.error > allowed ? 1e6 + found.error / allowed : found.error;
        if (excess > worst_excess) {
            worst = found;
            worst_excess = excess;
        }
    }
    return worst;
}

std::optional<Variant> find_variant(const std::string& name) {
    for (Variant& variant : shipped_variants()) {
        if (variant.field == kField && variant.name == name) return std::move(variant);
    }
    return std::nullopt;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const std::string through = arm.get(kThroughAxis);
    if (through == kTexture) {
        const Ramp ramp = through_texture(bench);
        return [ramp](double) { return judge_ramp(ramp, nullptr); };
    }
    if (through == kSrgbEncode || through == kToneMap) {
        const bool curve = through == kToneMap;
        const Ramp ramp = curve ? through_shader("displayed", radiance_shown_as)
                                : through_shader("srgb_encode", [](double linear) { return linear; });
        return [ramp](double) { return judge_ramp(ramp, nullptr); };
    }
    const auto variant = find_variant(through);
    CHECK_THAT(variant, "{}", through);
    return [variant = *variant, ramp = through_encoding(*variant)](double) { return judge_ramp(ramp, &variant); };
}

std::vector<ArmBlock> arms() {
    std::vector<std::string> ways{kTexture, kSrgbEncode, kToneMap};
    for (const Variant& variant : shipped_variants()) {
        if (variant.field == kField) ways.push_back(variant.name);
    }
    return {{{std::string(kThroughAxis), ways}}};
}

}  // namespace

extern const StressCase stress_srgb_ramp;
const StressCase stress_srgb_ramp{
    .id = "S28",
    .summary = "the 256 greys of sRGB through textures, base colours and the display's curve",
    .measures = "what comes back, at the level that is worst, in steps of 8-bit sRGB; black and white exactly",
    .unit = "step",
    .bound = 0.5,
    .bound_source = "half a step: the level is still the nearest; the law: half of the format's own, all to truncate",
    .failure = "colours too dark or washed out (encoded twice or never); white that is not 1 (a wrong range)",
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
