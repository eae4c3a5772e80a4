#include "bench/encodings/field_kind.h"
#include "bench/stress/case.h"
#include "bench/stress/normal_variants.h"
#include "bench/stress/shader_call.h"
#include "renderer/base/random.h"
#include "renderer/gl/buffer.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace lightsweep {
namespace {

constexpr int kColumns = 256;       // ShaderCall's
constexpr size_t kCodes = 65536;    // of them: all pairs of 8-bit codes, or as many random ones
constexpr size_t kFiltered = 4096;  // between codes, as a bilinear filter makes them
constexpr double kLengthBound = 1e-6;
// The peak at n = v = l goes with the length to the power -5: -4 of the distribution, -2 of the masking, 1 of n.l.
constexpr double kPeakBound = 5.0 * kLengthBound + 16.0 * 0x1p-24;
constexpr double kRoughness = 0.1;

// What a channel can hold: evenly spaced values, or any number.
class ChannelValues {
  public:
    explicit ChannelValues(const std::optional<ChannelGrid>& grid) : grid_(grid) {
        if (!grid) return;
        low_ = static_cast<int>(std::ceil((-1.0 - grid->offset) / grid->step - 1e-6));
        high_ = static_cast<int>(std::floor((1.0 - grid->offset) / grid->step + 1e-6));
    }
    size_t count() const { return grid_ ? static_cast<size_t>(high_ - low_ + 1) : 0; }
    float code(size_t k) const {
        return static_cast<float>(grid_->offset + (low_ + static_cast<int>(k)) * grid_->step);
    }
    float any(Random& random) const {
        return grid_ ? code(random.index(count())) : static_cast<float>(random.uniform(-1.0, 1.0));
    }
    /// The ones nearest to 0, and the ends.
    std::vector<float> special() const {
        if (!grid_) return {-1.0F, -1e-30F, 0.0F, 1e-7F, 1.0F};
        const auto middle = static_cast<size_t>(static_cast<int>(std::lround(-grid_->offset / grid_->step)) - low_);
        return {code(0), code(middle - 1), code(middle), code(middle + 1), code(count() - 1)};
    }

  private:
    std::optional<ChannelGrid> grid_;
    int low_ = 0, high_ = 0;
};

std::vector<ShaderInput> stored_values(const Variant& variant) {
    const StoredField& stored = variant.stored();
    const ChannelValues values(channel_grid(variant.layout.targets.front().format, stored, 0));
    const bool three = stored.slots.size() == 3;
    std::vector<ShaderInput> inputs;
    const auto add = [&](float x, float y, float z) {
        inputs.push_back({.a = glm::vec4(x, y, three ? z : 0.0F, 0.0F)});
    };
    for (const float x : values.special()) {
        for (const float y : values.special()) {
            for (const float z : values.special()) add(x, y, z);
        }
    }
    Random random(27);
    if (!three && values.count() > 0 && values.count() <= 256) {
        for (size_t x = 0; x < values.count(); ++x) {
            for (size_t y = 0; y < values.count(); ++y) add(values.code(x), values.code(y), 0.0F);
        }
    } else {
        for (size_t i = 0; i < kCodes; ++i) {
            const float x = values.any(random), y = values.any(random);
            add(x, y, values.any(random));
        }
    }
    for (size_t i = 0; i < kFiltered; ++i) {
        const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
        const glm::vec3 between(glm::dvec3(x, y, random.uniform(-1.0, 1.0)));
        add(between.x, between.y, between.z);
    }
    return inputs;
}

StressMeasurement compare(const std::vector<ShaderInput>& inputs, const std::vector<glm::vec4>& results, bool of_peak) {
    const double alpha = kRoughness * kRoughness;
    const double peak = 0.25 / (std::numbers::pi * alpha * alpha);
    StressMeasurement found{.bound = of_peak ? kPeakBound : kLengthBound};
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double length = glm::length(glm::dvec3(results[i]));
        const double error = of_peak ? std::abs(double{results[i].w} / peak - 1.0) : std::abs(length - 1.0);
        const bool finite = std::isfinite(error);
        if (finite && error <= found.error) continue;
        if (finite) found.error = error;
        if (!finite) ++found.non_finite;
        // Of what is not finite the first one is told, of the rest the worst.
        if (found.non_finite > 1 || (finite && found.non_finite > 0)) continue;
        found.where = fmt::format("the channels ({:.7g}, {:.7g}, {:.7g})", inputs[i].a.x, inputs[i].a.y, inputs[i].a.z);
    }
    return found;
}

std::vector<ArmBlock> arms() { return {{normal_encodings(), {"of", {"length", "peak"}}}}; }

StressTrial begin(Workbench&, const StressArm& arm) {
    const Variant variant = normal_variant(arm);
    const Encoding& encoding = variant.stored().encoding;
    const auto inputs = stored_values(variant);
    const shared::FrameData frame =
        probe_constants(variant, kColumns, static_cast<int>((inputs.size() + kColumns - 1) / kColumns));
    const gl::Buffer constants(std::as_bytes(std::span(&frame, 1)), "frame constants");
    constants.bind_uniform(shared::kFrameBlock);
    const std::string body =
        fmt::format("vec3 n = decode_{}(a.{}{});\nresult = vec4(n, light_lobes(n, {}, MODEL_GGX, n, n).f0);",
                    encoding.key, encoding.channels.size() == 3 ? "xyz" : "xy",
                    encoding.needs.pixel ? ", ivec2(gl_FragCoord.xy)" : "", kRoughness);
    const ShaderCall call({"lib/brdf.glsl", "gbuffer/encodings/" + encoding.key + ".glsl"}, body, {"HAS_GGX"});
    const StressMeasurement found = compare(inputs, call(inputs), arm.get("of") == "peak");
    return [found](double) { return found; };
}

}  // namespace

extern const StressCase stress_decoded_length{
    .id = "S27",
    .summary =
        "stored values that are not of unit length, all codes and between them, decoded by every normal encoding",
    .measures = "length of the decoded normal less 1, and the GGX peak with it over the exact peak less 1",
    .unit = "rel",
    .bound = kLengthBound,
    .bound_source = "16 roundings of 2^-24; the peak goes with the length to the power -5",
    .failure = "highlights that are too bright or too dim, in steps",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
