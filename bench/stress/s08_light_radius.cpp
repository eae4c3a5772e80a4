// S8: surfaces just inside, at and just outside of a light's radius, radii that are none, and lights that take away.
#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "bench/stress/test_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace lightsweep {
namespace {

constexpr int kSize = 33;                           // odd: one pixel centre sees the very point below the light
constexpr double kHeight = 0.5;                     // of the lights over the plane
constexpr std::string_view kFunction = "function";  // the axis of the arm that calls the shader's function alone

struct LightSet {
    const char* name;
    double radius;
    double sign = 1.0;  // of the intensity
    bool dark = false;  // it reaches nothing
};

std::vector<LightSet> sets_at(double gap) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {{.name = "just inside the radius", .radius = kHeight / (1.0 - gap)},
            {.name = "at the radius", .radius = kHeight, .dark = true},
            {.name = "just outside the radius", .radius = kHeight * (1.0 - gap), .dark = true},
            {.name = "no radius", .radius = 0.0, .dark = true},
            {.name = "a negative radius", .radius = -1.0, .dark = true},
            {.name = "a large radius", .radius = 1.0 / gap},
            {.name = "an infinite radius", .radius = kInfinity},
            {.name = "negative intensity", .radius = 2.0, .sign = -1.0}};
}

std::vector<Light> lights_of(const LightSet& set) {
    const glm::dvec3 color = set.sign * glm::dvec3(0.9, 0.6, 0.3);
    return {point_light({0.0, 0.0, kHeight}, set.radius, color),
            spot_light({0.0, 0.0, kHeight}, {0.1, 0.2, -1.0}, set.radius, 50.0, color)};
}

std::shared_ptr<Drawing> draw_with(Workbench& bench, const StressArm& arm, SkipSet skips) {
    Scene scene = facing_plane({.name = "plane", .base_color = glm::vec3(0.5F), .roughness = 0.5F}, 3.0, 2.0);
    declare_light_kinds(scene, true, true, false);
    return std::make_shared<Drawing>(bench, arm, std::move(scene), kSize, kSize, skips);
}

double brightest(const Image& image) { return *std::ranges::max_element(image.rgb); }

// Every path that skips what it can against the forward path that skips nothing.
StressTrial try_path(Workbench& bench, const StressArm& arm) {
    const StressArm brute({{std::string(kPathAxis), "forward"}, {std::string(kGuardsAxis), arm.get(kGuardsAxis)}});
    const auto skipping = draw_with(bench, arm, SkipSet::all());
    const auto whole = draw_with(bench, brute, SkipSet::none());
    whole->set_lights(lights_of({.name = "", .radius = 100.0}));
    const double full = brightest(whole->draw());
    return [skipping, whole, full](double gap) {
        StressMeasurement found;
        for (const LightSet& set : sets_at(gap)) {
            skipping->set_lights(lights_of(set));
            whole->set_lights(lights_of(set));
            const Image image = skipping->draw(), expected = whole->draw();
            const PictureErrors errors = picture_errors(expected, image, full);
            const double leak = set.dark ? std::max(brightest(image), brightest(expected)) / full : 0.0;
            found.non_finite += errors.non_finite + count_non_finite(expected);
            const double error = std::max(errors.max, leak);
            if (!(error > found.error)) continue;
            found.error = error;
            found.where = fmt::format("{}, {}", set.name, errors.where());
        }
        return found;
    };
}

// The light's function, at distances that are floats: nothing at the radius and past it, and the window inside.
StressTrial try_function(const StressArm& arm) {
    std::vector<std::string> defines;
    if (arm.get(kGuardsAxis) == "off") defines.emplace_back("UNGUARDED");
    const auto call = std::make_shared<ShaderCall>(
        std::vector<std::string>{"lib/light.glsl"},
        "LightData light = LightData(a.xyz, a.w, vec3(1.0), 0.0, vec3(0.0, 0.0, -1.0), 1.0);\n"
        "Incident incident = local_light(light, b.xyz);\n"
        "result = vec4(incident.irradiance.x, reaches(light, b.xyz) ? 1.0 : 0.0, incident.direction.xy);",
        defines);
    return [call](double gap) {
        constexpr float kFar = std::numeric_limits<float>::infinity();
        const std::vector<float> radii{0.3F, 1.0F, 7.0F, 1e-3F, 1e6F};
        std::vector<ShaderInput> inputs;
        std::vector<float> distances;
        for (const float radius : radii) {
            const auto inside = static_cast<float>(radius * (1.0 - gap)),
                       outside = static_cast<float>(radius * (1.0 + gap));
            for (const float distance :
                 {inside, radius, std::nextafter(radius, kFar), std::max(outside, std::nextafter(radius, kFar))}) {
                distances.push_back(distance);
                inputs.push_back({.a = {0.0F, 0.0F, 0.0F, radius}, .b = {0.0F, 0.0F, distance, 0.0F}});
            }
        }
        const auto results = (*call)(inputs);
        StressMeasurement found;
        for (size_t i = 0; i < results.size(); ++i) {
            const double radius = inputs[i].a.w, distance = distances[i];
            const double ratio = distance / radius, window = std::max(1.0 - ratio * ratio * ratio * ratio, 0.0);
            const double given = results[i].x * std::max(distance * distance, 1e-4);
            found.non_finite += std::isfinite(results[i].x) ? 0 : 1;
            double error = std::abs(given - window * window);
            if (distance >= radius && (results[i].x != 0.0F || results[i].y != 0.0F)) error = 1.0;
            if (!(error > found.error)) continue;
            found.error = error;
            found.where = fmt::format("radius {:.9g}, distance {:.9g}", radius, distance);
        }
        return found;
    };
}

std::vector<ArmBlock> arms() {
    ArmBlock paths = every_path();
    paths.push_back({std::string(kGuardsAxis), {"on"}});
    return {paths, {{std::string(kFunction), {"local_light"}}, {std::string(kGuardsAxis), {"on"}}}};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    return arm.get(kFunction).empty() ? try_path(bench, arm) : try_function(arm);
}

}  // namespace

extern const StressCase stress_light_radius;
const StressCase stress_light_radius{
    .id = "S8",
    .summary = "lights whose radius ends at the surface, is none, or has no end; lights that take away",
    .measures = "difference to a forward path that skips nothing, and any light past the radius, of full brightness",
    .unit = "rel",
    .bound = 0x1p-16,
    .bound_source =
        "256 roundings of 2^-24: 60 of the light and its lobe, magnified up to 4 times by the window's slope",
    .failure = "lights that end in an edge, hang on past their radius, or vanish with parts of the picture",
    .parameter = StressParameter{.name = "gap to the radius", .unit = "of it", .easy = 0.5, .hard = 1e-6, .steps = 7},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
