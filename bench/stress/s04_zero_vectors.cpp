#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/random.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace lightsweep {
namespace {

constexpr int kSize = 33;  // odd: one pixel looks straight ahead
constexpr double kPictureBound = 1e-2;
constexpr double kAngleBoundDeg = 5.0;  // of 8-bit normals, with room; a wrong fallback is off by far more

// Side by side, facing the eye: vertex normals of zero; normals that cancel out along a line; a normal map between
// 127 and 128, which is nearly zero; triangles without area among sound ones; normals that face away, with a sun
// behind: there one pixel's light comes from just opposite its eye.
Scene vanishing_vectors() {
    Scene scene;
    scene.key = "zero_vectors";
    scene.textures.push_back(
        {.name = "nearly no normal", .width = 2, .height = 1, .rgba = {127, 127, 127, 255, 128, 128, 128, 255}});
    const Material plain{.name = "plain", .base_color = {0.5F, 0.4F, 0.3F}, .roughness = 0.4F};
    Material mapped = plain;
    mapped.normal_texture = 0;
    const auto add = [&](Geometry geometry, const Material& material, double x) {
        add_instance(scene, geometry, material, glm::translate(glm::dmat4(1.0), {x, 0.0, 0.0}));
    };
    const Geometry quad = make_shape(QuadShape{.size = {1.0, 4.0}});

    Geometry zero = quad;
    for (Vertex& vertex : zero.vertices) vertex.normal = glm::vec3(0.0F);
    add(zero, plain, -2.0);

    Geometry cancelling = quad;
    for (Vertex& vertex : cancelling.vertices) vertex.normal = {0.0F, vertex.position.y > 0.0F ? 0.6F : -0.6F, 0.8F};
    for (Vertex& vertex : cancelling.vertices) vertex.normal.z = vertex.position.x > 0.0F ? 0.8F : -0.8F;
    add(cancelling, plain, 2.0);

    Geometry flat = quad;
    for (const uint32_t corner : {0U, 1U, 1U, 2U, 2U, 2U}) flat.indices.push_back(corner);
    add(flat, mapped, -1.0);
    add(flat, plain, 1.0);

    Geometry away = quad;
    for (Vertex& vertex : away.vertices) vertex.normal = {0.0F, 0.0F, -1.0F};
    add(away, plain, 0.0);

    scene.camera = {.eye = {0.0, 0.0, 4.5}, .target = glm::dvec3(0.0)};
    scene.lights.fixed = {sun({0.0, 0.0, 1.0}, glm::dvec3(1.0)), sun({0.2, -0.3, -1.0}, glm::dvec3(1.0)),
                          point_light({0.3, 0.5, 1.5}, 5.0, glm::dvec3(2.0))};
    return scene;
}

StressTrial begin_picture(Workbench& bench, const StressArm& arm) {
    const auto drawing = std::make_shared<Drawing>(bench, arm, vanishing_vectors(), kSize, kSize);
    return [drawing](double) {
        const Image picture = drawing->draw();
        const auto exact = drawing->reference();
        StressMeasurement found{.non_finite = count_non_finite(picture)};
        for (size_t i = 0; i < exact.size(); ++i) {
            const double off = std::abs(double{picture.rgb[3 * i]} - exact[i].r) / std::max(exact[i].r, 1e-3);
            if (off <= kPictureBound) continue;
            if (found.error++ == 0.0) found.where = fmt::format("first pixel ({}, {})", i % kSize, i / kSize);
        }
        return found;
    };
}

// What the G-buffer gives back: a unit normal, near the exact one where that faces the eye (what faces away, some
// layouts do not hold).
StressTrial begin_decoded(Workbench& bench, const StressArm& arm) {
    const auto drawing = std::make_shared<Drawing>(bench, arm, vanishing_vectors(), kSize, kSize);
    return [drawing](double) {
        const auto decoded = drawing->decoded();
        const auto exact = drawing->surfaces();
        StressMeasurement found;
        for (size_t i = 0; i < exact.size(); ++i) {
            if (!exact[i].covered) continue;
            const DecodedSurface& s = decoded[i];
            const float values[] = {s.normal.x,     s.normal.y,     s.normal.z,   s.base_color.r,
                                    s.base_color.g, s.base_color.b, s.position.z, s.roughness};
            found.non_finite += std::ranges::count_if(values, [](float v) { return !std::isfinite(v); });
            const glm::dvec3 normal(s.normal);
            const bool is_unit = std::abs(glm::length(normal) - 1.0) < 1e-5;
            const bool faces_eye = glm::dot(exact[i].normal, exact[i].position) < 0.0;
            const bool is_near = glm::dot(normal, exact[i].normal) > std::cos(glm::radians(kAngleBoundDeg));
            if (is_unit && (is_near || !faces_eye)) continue;
            if (found.error++ == 0.0) found.where = fmt::format("first pixel ({}, {})", i % kSize, i / kSize);
        }
        return found;
    };
}

// --- Values ---

glm::vec3 direction(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

// result: what must be a unit vector (length 1) or no specular light (0).
struct Values {
    std::string_view name;
    const char* body;
    const char* include;
    double expected;
};
// a: a unit normal. b: another unit vector. c.x: a length from 0 to 1e-4.
constexpr Values kValues[] = {
    {"half_ggx",
     "vec3 l = dot(a, b) > 0.0 ? b.xyz : -b.xyz;\nLobes lobes = light_lobes(a.xyz, 0.3, MODEL_GGX, -l, l);\n"
     "result.x = lobes.f0 + lobes.f90;",
     "lib/brdf.glsl", 0.0},
    {"half_blinn_phong",
     "vec3 l = dot(a, b) > 0.0 ? b.xyz : -b.xyz;\nresult.x = light_lobes(a.xyz, 0.3, MODEL_BLINN_PHONG, -l, l).f0;",
     "lib/brdf.glsl", 0.0},
    {"filtered_normal",
     "vec4 tangent = vec4(normalize(cross(a.xyz, b.xyz)), 1.0);\n"
     "result.x = dot(from_tangent_space(b.xyz * c.x, a.xyz, tangent, a.xyz), a.xyz);",
     "lib/material.glsl", 1.0},
    {"no_normal", "result.x = dot(safe_normalize(vec3(0.0), a.xyz), a.xyz);", "lib/safe_normalize.glsl", 1.0},
};

StressTrial begin_values(const StressArm& arm) {
    const Values& values =
        *std::ranges::find(kValues, arm.get("values"), [](const Values& v) { return std::string(v.name); });
    std::vector<std::string> defines{"HAS_NORMAL_TEXTURE", "HAS_GGX", "HAS_BLINN_PHONG", "MULTIPLE_MODELS"};
    if (arm.get(kGuardsAxis) == "off") defines.emplace_back("UNGUARDED");
    const auto call = std::make_shared<ShaderCall>(std::vector<std::string>{values.include}, values.body, defines);
    return [call, expected = values.expected](double) {
        Random random(4);
        std::vector<ShaderInput> inputs;
        for (int i = 0; i < 4096; ++i) {
            const float length = i == 0 ? 0.0F : static_cast<float>(1e-4 * std::pow(random.uniform(), 8.0));
            const glm::vec3 normal = direction(random);
            inputs.push_back(
                {.a = glm::vec4(normal, 0.0F), .b = glm::vec4(direction(random), 0.0F), .c = glm::vec4(length)});
        }
        StressMeasurement found;
        for (const glm::vec4& result : (*call)(inputs)) {
            const double off = std::abs(double{result.x} - expected);
            found.non_finite += std::isfinite(off) ? 0 : 1;
            found.error += off > 1e-6 ? 1.0 : 0.0;
        }
        return found;
    };
}

std::vector<ArmBlock> arms() {
    StressAxis axis{.name = "values", .values = {}};
    for (const Values& values : kValues) axis.values.emplace_back(values.name);
    ArmBlock decoded = every_layout();
    decoded.push_back({"gbuffer", {"decoded"}});
    return {{axis, {std::string(kGuardsAxis), {"on"}}}, every_path(), decoded};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    if (!arm.get("values").empty()) return begin_values(arm);
    return arm.get("gbuffer").empty() ? begin_picture(bench, arm) : begin_decoded(bench, arm);
}

}  // namespace

extern const StressCase stress_zero_vectors{
    .id = "S4",
    .summary = "vectors of length zero: vertex normals, filtered normal maps, half vectors; triangles without area",
    .measures = "pixels or values that are off what takes the vector's place: the triangle's normal, or no highlight",
    .unit = "count",
    .bound = 0.0,
    .bound_source = "none may be off: by 1 % of a pixel, 5 degrees of a stored normal, 1e-6 of a value",
    .failure = "black or white specks on folds, seams and degenerate triangles",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
