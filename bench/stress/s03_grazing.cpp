// S3: view and light that graze the surface, through the lobes alone.
#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "renderer/base/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace lightsweep {
namespace {

constexpr float kAlphas[] = {0.002F, 0.01F, 0.1F, 0.5F, 1.0F};
constexpr double kTurns[] = {0.0, 1e-3, 0.5, 1.6, 2.6, std::numbers::pi - 1e-3, std::numbers::pi};
constexpr double kSteepCosines[] = {0.2, 0.7, 0.999};
constexpr double kF0 = 0.04;
constexpr int kAskew = 256;

glm::dvec3 at_cosine(double cosine, double azimuth) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return {std::cos(azimuth) * sine, std::sin(azimuth) * sine, cosine};
}

ShaderInput call_of(const glm::dvec3& normal, float alpha, const glm::dvec3& v, const glm::dvec3& l) {
    return {.a = glm::vec4(glm::vec3(normal), std::sqrt(alpha)),
            .b = glm::vec4(glm::vec3(v), 0.0F),
            .c = glm::vec4(glm::vec3(l), 0.0F)};
}

// Of one pair of directions: l at the small cosine; the two swapped; l at half of that cosine.
struct Trial {
    float alpha;
    double grazing, other;  // n.l and n.v of the first call
    bool falls;             // the third call must give less than the first
};

struct Inputs {
    std::vector<Trial> trials;
    std::vector<ShaderInput> calls;  // three for each trial, then those that must only be finite

    void add(float alpha, double grazing, double other, double turn) {
        const glm::dvec3 up(0.0, 0.0, 1.0);  // the cosines are then what the shader computes, to the last bit
        constexpr double kAzimuth = 0.4;
        const glm::dvec3 v = at_cosine(other, kAzimuth);
        const glm::dvec3 l = at_cosine(grazing, kAzimuth + turn);
        trials.push_back({alpha, grazing, other, other > 2.0 * grazing});
        calls.push_back(call_of(up, alpha, v, l));
        calls.push_back(call_of(up, alpha, l, v));
        calls.push_back(call_of(up, alpha, v, at_cosine(0.5 * grazing, kAzimuth + turn)));
    }
};

Inputs inputs_at(double cosine) {
    Inputs inputs;
    for (const float alpha : kAlphas) {
        for (const double turn : kTurns) {
            for (const double other : kSteepCosines) inputs.add(alpha, cosine, other, turn);
            inputs.add(alpha, cosine, cosine, turn);
        }
    }
    Random random(3);
    for (int i = 0; i < kAskew; ++i) {
        const glm::dvec3 normal = at_cosine(random.uniform(-1.0, 1.0), random.uniform(0.0, 6.3));
        const glm::dvec3 side = glm::normalize(glm::cross(normal, at_cosine(0.1, random.uniform(0.0, 6.3))));
        const glm::dvec3 l = glm::normalize(side + cosine * normal);
        const glm::dvec3 v = i % 2 == 0 ? -l : glm::normalize(-side + cosine * normal);  // opposed, or nearly so
        inputs.calls.push_back(call_of(normal, kAlphas[i % 5], v, l));
    }
    return inputs;
}

// Of a dielectric without a diffuse part.
double specular(const glm::vec4& lobes) { return kF0 * lobes.y + lobes.z; }

double relative(double difference, double magnitude) { return magnitude > 0.0 ? difference / magnitude : 0.0; }

StressMeasurement examine(const Inputs& inputs, const std::vector<glm::vec4>& lobes) {
    StressMeasurement found;
    const auto note = [&](double error, const Trial& trial, const char* what) {
        if (!(error > found.error)) return;
        found.error = error;
        found.where =
            fmt::format("{}: alpha {}, cosines {:.3g} and {:.3g}", what, trial.alpha, trial.grazing, trial.other);
    };
    for (size_t i = 0; i < inputs.trials.size(); ++i) {
        const Trial& trial = inputs.trials[i];
        const double there = specular(lobes[3 * i]) / trial.grazing, back = specular(lobes[3 * i + 1]) / trial.other;
        note(relative(std::abs(there - back), std::max(there, back)), trial, "light and eye are not exchangeable");
        const double at = specular(lobes[3 * i]), lower = specular(lobes[3 * i + 2]);
        if (trial.falls) note(relative(lower - at, at), trial, "more light at half of the cosine");
    }
    for (const glm::vec4& value : lobes) {
        for (int c = 0; c < 3; ++c) found.non_finite += std::isfinite(value[c]) ? 0 : 1;
    }
    if (found.non_finite > 0) found.where = "of lobes";
    return found;
}

std::vector<ArmBlock> arms() { return {{{"model", {"ggx", "blinn_phong"}}, {std::string(kGuardsAxis), {"on"}}}}; }

StressTrial begin(Workbench&, const StressArm& arm) {
    std::vector<std::string> defines{arm.get("model") == "ggx" ? "HAS_GGX" : "HAS_BLINN_PHONG"};
    if (arm.get(kGuardsAxis) == "off") defines.emplace_back("UNGUARDED");
    const auto call = std::make_shared<ShaderCall>(std::vector<std::string>{"lib/brdf.glsl"},
                                                   "Lobes lobes = light_lobes(a.xyz, a.w, 0u, b.xyz, c.xyz);\n"
                                                   "result = vec4(lobes.diffuse, lobes.f0, lobes.f90, 0.0);",
                                                   defines);
    return [call](double cosine) {
        const Inputs inputs = inputs_at(cosine);
        return examine(inputs, (*call)(inputs.calls));
    };
}

}  // namespace

extern const StressCase stress_grazing;
const StressCase stress_grazing{
    .id = "S3",
    .summary = "view and light that graze the surface, alone and both",
    .measures = "f(v, l) against f(l, v), and by how much a light grows that sinks to half of its cosine",
    .unit = "rel",
    .bound = 0x1p-20,
    .bound_source =
        "16 roundings of 2^-24: the two orders differ in products with n.l alone, and a rounding of n.l itself",
    .failure = "bright or black rims, and rims that flicker as the camera moves",
    .parameter = StressParameter{.name = "cosine", .unit = "", .easy = 0.1, .hard = 1e-7, .steps = 7},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
