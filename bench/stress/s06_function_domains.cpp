#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "bench/stress/shader_functions.h"
#include "renderer/base/check.h"
#include "renderer/gl/buffer.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace lightsweep {
namespace {

// A function as shaders use it. `value` is GLSL for a vec3 of the float x, which is in the domain up to `end`.
struct Guarded {
    std::string_view name;
    std::vector<std::string> includes;
    std::string value;
    double end;
    double outwards;  // 1: the domain ends above; -1: below
    std::vector<std::string> defines = {};
};

// A half vector of height x above the surface: below 0 where the eye is far enough below the horizon. n.l is the same.
const char* const kPhong = R"(
vec3 phong(float x, float roughness) {
    vec3 l = vec3(sqrt(0.75), 0.0, 0.5);
    vec3 h = vec3(sqrt(1.0 - x * x), 0.0, x);
    vec3 v = 2.0 * dot(h, l) * h - l;
    return vec3(light_lobes(vec3(0.0, 0.0, 1.0), roughness, MODEL_BLINN_PHONG, v, l).f0);
}
)";

const std::vector<Guarded>& guarded_functions() {
    static const std::vector<Guarded> functions = {
        {"sqrt_below_0", {"gbuffer/encodings/sqrt.glsl"}, "vec3(encode_sqrt(x))", 0.0, -1.0},
        {"gamma2_below_0", {"gbuffer/encodings/gamma2.glsl"}, "encode_gamma2(vec3(x, 0.5, x))", 0.0, -1.0},
        {"log2_below_0", {"gbuffer/encodings/log2.glsl"}, "vec3(encode_log2(x))", 0.0, -1.0},
        {"ycocg_below_0",
         {"gbuffer/encodings/ycocg.glsl"},
         "vec3(encode_ycocg(vec3(x, 0.25, x), ivec2(0)), 0.0)",
         0.0,
         -1.0},
        {"rgb9e5_below_0",
         {"gbuffer/encodings/rgb9e5.glsl"},
         "decode_rgb9e5(encode_rgb9e5(vec3(x, 1.0, x)))",
         0.0,
         -1.0},
        {"rgb9e5_above_65408",
         {"gbuffer/encodings/rgb9e5.glsl"},
         "decode_rgb9e5(encode_rgb9e5(vec3(65408.0 * x)))",
         1.0,
         1.0},
        {"rgb4e3_below_0",
         {"gbuffer/encodings/rgb4e3.glsl"},
         "decode_rgb4e3(encode_rgb4e3(vec3(x, 1.0, x)))",
         0.0,
         -1.0},
        {"rgb4e3_above_30",
         {"gbuffer/encodings/rgb4e3.glsl"},
         "decode_rgb4e3(encode_rgb4e3(vec3(30.0 * x)))",
         1.0,
         1.0},
        {"spheremap_off_the_disc", {"gbuffer/encodings/spheremap.glsl"}, "decode_spheremap(vec2(0.0, x))", 1.0, 1.0},
        {"xy_z_off_the_disc", {"gbuffer/encodings/xy_z.glsl"}, "decode_xy_z(vec2(-x, 0.0), ivec2(40, 90))", 1.0, 1.0},
        {"srgb_below_0", {"lib/display.glsl"}, "displayed(vec3(x))", 0.0, -1.0},
        {"slice_below_0",
         {"shared/types.h", "shared/light_cell.h"},
         "vec3(float(slice_of(LightGridData(16u, 1u, 1u, 24u, 1.8, 6.0, 0.0, 0.0, 0.0, 0.0, 0u, 0u), x)))",
         0.0,
         -1.0},
        {"phong_below_0", {"lib/brdf.glsl"}, "phong(x, 0.5)", 0.0, -1.0, {"HAS_BLINN_PHONG"}},
        {"phong_power_0", {"lib/brdf.glsl"}, "phong(x, 1.0)", 0.0, -1.0, {"HAS_BLINN_PHONG"}},
    };
    return functions;
}

std::vector<ArmBlock> arms() {
    StressAxis axis{.name = "function", .values = {}};
    for (const Guarded& function : guarded_functions()) axis.values.emplace_back(function.name);
    return {{axis, {std::string(kGuardsAxis), {"on"}}}};
}

ShaderCall make_call(const Guarded& function, bool guards) {
    auto defines = function.defines;
    if (!guards) defines.emplace_back("UNGUARDED");
    const bool is_phong = function.value.starts_with("phong");
    return ShaderCall(function.includes, "float x = a.x;\nresult.xyz = " + function.value + ";", defines,
                      is_phong ? kPhong : "");
}

StressTrial begin(Workbench&, const StressArm& arm) {
    const auto function = std::ranges::find(guarded_functions(), arm.get("function"),
                                            [](const Guarded& f) { return std::string(f.name); });
    CHECK(function != guarded_functions().end());
    const auto call = std::make_shared<ShaderCall>(make_call(*function, arm.get(kGuardsAxis) == "on"));
    const shared::FrameData frame = call_frame();
    const auto constants = std::make_shared<gl::Buffer>(std::as_bytes(std::span(&frame, 1)), "frame constants");
    return [call, constants, function](double outside) {
        constants->bind_uniform(shared::kFrameBlock);
        const auto at = [](double x) { return ShaderInput{.a = glm::vec4(static_cast<float>(x), 0.0F, 0.0F, 0.0F)}; };
        const ShaderInput inputs[] = {at(function->end), at(function->end + function->outwards * outside)};
        const auto results = (*call)(inputs);
        StressMeasurement found{.where = fmt::format("x = {:.7g}", inputs[1].a.x)};
        for (int k = 0; k < 3; ++k) {
            const double at_end = double{results[0][k]}, beyond = double{results[1][k]};
            const double error = std::abs(beyond - at_end) / std::max(std::abs(at_end), 1.0);
            found.non_finite += std::isfinite(error) ? 0 : 1;
            if (std::isfinite(error)) found.error = std::max(found.error, error);
        }
        return found;
    };
}

}  // namespace

extern const StressCase stress_function_domains{
    .id = "S6",
    .summary = "roots, powers and logarithms of what is just outside of their domain",
    .measures = "the function's value against the one at the domain's nearest end",
    .unit = "rel",
    .bound = 1e-6,
    .bound_source = "the same value, but for a few roundings of 2^-24 in what surrounds it",
    .failure = "NaN in single pixels, which blending and blurs spread",
    .parameter = StressParameter{.name = "outside of the domain by", .unit = "", .easy = 1e-7, .hard = 0.5, .steps = 7},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
