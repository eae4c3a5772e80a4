#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/random.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace lightsweep {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 56, kHeight = 8;
constexpr uint8_t kTexel[] = {179, 160, 217, 255};

struct Frame {
    std::string_view name;
    glm::vec4 tangent;  // of a surface whose normal is +z
    bool mirrored = false;
};
constexpr Frame kFrames[] = {
    {"right", {1, 0, 0, 1}},          {"zero", {0, 0, 0, 1}},         {"along", {0, 0, 1, 1}},
    {"against", {0, 0, -1, -1}},      {"left_handed", {1, 0, 0, -1}}, {"no_number", {kNaN, kNaN, kNaN, kNaN}},
    {"mirrored", {1, 0, 0, 1}, true},
};

// --- In pictures: whichever tangent is taken, a normal map bends the normal by its own angle. A row of quads, one for
// --- each frame, lit along their normals, shows the cosine of that angle and nothing else.

glm::dvec3 texel_vector() { return 2.0 * glm::dvec3(kTexel[0], kTexel[1], kTexel[2]) / 255.0 - 1.0; }

// Facing +x, so that the x axis, which takes the place of a zero tangent, lies along the normal.
Scene row_of_quads() {
    Scene scene;
    scene.key = "tangent_frames";
    scene.textures.push_back(
        {.name = "slope", .width = 1, .height = 1, .rgba = {std::begin(kTexel), std::end(kTexel)}});
    const int count = static_cast<int>(std::size(kFrames));
    for (int i = 0; i < count; ++i) {
        Geometry quad = make_shape(QuadShape{});
        for (Vertex& vertex : quad.vertices) vertex.tangent = kFrames[i].tangent;
        const glm::dvec3 place(0.0, 0.0, 0.5 * (count - 1) - i);
        glm::dmat4 transform = glm::rotate(glm::translate(glm::dmat4(1.0), place), 0.5 * std::numbers::pi, {0, 1, 0});
        if (kFrames[i].mirrored) transform = glm::scale(transform, {-1, 1, 1});
        add_instance(scene, quad, {.name = "map", .model = ShadingModel::lambert, .normal_texture = 0}, transform);
    }
    // One unit high in the picture.
    scene.camera = {.eye = {4.0, 0.0, 0.0},
                    .target = glm::dvec3(0.0),
                    .fov_y_deg = 2.0 * glm::degrees(std::atan(0.5 / 4.0)),
                    .near_distance = 1.0,
                    .far_distance = 10.0};
    scene.lights.fixed = {sun({-1, 0, 0}, glm::dvec3(1.0))};
    return scene;
}

StressTrial begin_picture(Workbench& bench, const StressArm& arm) {
    const auto drawing = std::make_shared<Drawing>(bench, arm, row_of_quads(), kWidth, kHeight);
    return [drawing](double) {
        const glm::dvec3 slope = texel_vector();
        const double expected = slope.z / glm::length(slope) / std::numbers::pi;
        const Image picture = drawing->draw();
        StressMeasurement found{.non_finite = count_non_finite(picture)};
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double error = std::abs(double{*picture.pixel(x, y)} / expected - 1.0);
                if (error <= found.error) continue;
                if (std::isfinite(error)) found.error = error;
                found.where = fmt::format("the frame '{}'", kFrames[x * std::ssize(kFrames) / kWidth].name);
            }
        }
        return found;
    };
}

// --- In values: the frame that a map's axes are turned into is orthonormal, and of the handedness asked for.

ShaderInput turned_frame(Random& random, const Frame& frame) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const glm::dvec3 axis =
        glm::normalize(glm::dvec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)));
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, axis));
    const glm::dvec3 tangent(frame.tangent);
    return {.a = glm::vec4(turn * glm::dvec3(0.0, 0.0, 1.0), 0.0),
            .b = glm::vec4(glm::vec3(turn * tangent), frame.tangent.w)};
}

StressTrial begin_values(const StressArm& arm) {
    const Frame frame =
        *std::ranges::find(kFrames, arm.get("frame"), [](const Frame& f) { return std::string(f.name); });
    std::vector<std::string> defines{"HAS_NORMAL_TEXTURE"};
    if (arm.get(kGuardsAxis) == "off") defines.emplace_back("UNGUARDED");
    const auto call =
        std::make_shared<ShaderCall>(std::vector<std::string>{"lib/material.glsl"},
                                     "vec3 x = from_tangent_space(vec3(1.0, 0.0, 0.0), a.xyz, b, a.xyz);\n"
                                     "vec3 y = from_tangent_space(vec3(0.0, 1.0, 0.0), a.xyz, b, a.xyz);\n"
                                     "vec3 z = from_tangent_space(vec3(0.0, 0.0, 1.0), a.xyz, b, a.xyz);\n"
                                     "result = vec4(determinant(mat3(x, y, z)), dot(x, y), dot(y, z), dot(z, x));",
                                     defines);
    return [call, frame](double) {
        Random random(22);
        std::vector<ShaderInput> inputs;
        for (int i = 0; i < 4096; ++i) inputs.push_back(turned_frame(random, frame));
        const double handedness = frame.tangent.w < 0.0F ? -1.0 : 1.0;
        StressMeasurement found;
        for (const glm::vec4& result : (*call)(inputs)) {
            const double errors[] = {std::abs(double{result.x} - handedness), std::abs(double{result.y}),
                                     std::abs(double{result.z}), std::abs(double{result.w})};
            const double error = *std::ranges::max_element(errors);
            const double sum = errors[0] + errors[1] + errors[2] + errors[3];
            found.non_finite += std::isfinite(sum) ? 0 : 1;
            if (std::isfinite(sum)) found.error = std::max(found.error, error);
        }
        return found;
    };
}

std::vector<ArmBlock> arms() {
    StressAxis frames{.name = "frame", .values = {}};
    for (const Frame& frame : kFrames) {
        if (!frame.mirrored) frames.values.emplace_back(frame.name);
    }
    return {{frames, {std::string(kGuardsAxis), {"on"}}}, every_path()};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    return arm.get("frame").empty() ? begin_picture(bench, arm) : begin_values(arm);
}

}  // namespace

extern const StressCase stress_tangent_frames{
    .id = "S22",
    .summary = "normal maps on tangents that are zero, along the normal, mirrored, or no number",
    .measures = "the frame's determinant and right angles; light on the bent normal, in pictures",
    .unit = "rel",
    .bound = 1e-5,
    .bound_source = "some eighty roundings of 2^-23 from the vertices to the picture",
    .failure = "black, white or flipped relief where texture coordinates fold or collapse",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
