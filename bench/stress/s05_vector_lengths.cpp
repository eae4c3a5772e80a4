#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "bench/stress/ulp.h"
#include "renderer/base/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace lightsweep {
namespace {

constexpr size_t kVectors = 1024;

struct Function {
    std::string_view name;
    const char* include;
    const char* body;
};
// The matrix is a rotation by quarters, so that only the normalisation rounds.
constexpr Function kFunctions[] = {
    {"safe_normalize", "lib/safe_normalize.glsl", "result.xyz = safe_normalize(a.xyz, vec3(0.0));"},
    {"world_normal", "lib/instance.glsl",
     "InstanceData i;\ni.normal_x = vec4(0.0, 1.0, 0.0, 0.0);\ni.normal_y = vec4(-1.0, 0.0, 0.0, 0.0);\n"
     "i.normal_z = vec4(0.0, 0.0, 1.0, 0.0);\nvec3 n = world_normal(i, a.xyz);\nresult.xyz = vec3(n.y, -n.x, n.z);"},
};

glm::dvec3 direction(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

std::vector<ArmBlock> arms() {
    return {{{"function", {"safe_normalize", "world_normal"}}, {"way", {"long", "short"}}, {"guards", {"on"}}}};
}

StressTrial begin(Workbench&, const StressArm& arm) {
    const auto& function =
        *std::ranges::find(kFunctions, arm.get("function"), [](const Function& f) { return std::string(f.name); });
    std::vector<std::string> defines;
    if (arm.get(kGuardsAxis) == "off") defines.emplace_back("UNGUARDED");
    const auto call = std::make_shared<ShaderCall>(std::vector<std::string>{function.include}, function.body, defines);
    const bool is_long = arm.get("way") == "long";
    return [call, is_long](double factor) {
        Random random(5);
        std::vector<ShaderInput> inputs(kVectors);
        for (auto& input : inputs) {
            input.a = glm::vec4(direction(random) * (is_long ? factor : 1.0 / factor), 0.0);
        }
        const auto results = (*call)(inputs);
        StressMeasurement found;
        for (size_t i = 0; i < inputs.size(); ++i) {
            const glm::dvec3 exact = glm::normalize(glm::dvec3(inputs[i].a));
            const double ulps = ulps_off(&results[i].x, &exact.x, 3);
            if (!std::isfinite(ulps)) {
                ++found.non_finite;
            } else if (ulps > found.error) {
                found.error = ulps;
                found.where = fmt::format("({:.7g}, {:.7g}, {:.7g})", inputs[i].a.x, inputs[i].a.y, inputs[i].a.z);
            }
        }
        return found;
    };
}

}  // namespace

extern const StressCase stress_vector_lengths{
    .id = "S5",
    .summary = "normalises vectors from length 1 to 1e30 (way=long) and to 1e-30 (way=short)",
    .measures = "components of the unit vector",
    .unit = "ulp",
    .bound = 4.0,
    .bound_source =
        "three roundings of the square's sum, halved by the root; 2 ulp of inversesqrt (GLSL 4.7.1); a product",
    .failure = "black or white spots on very small and very large models",
    .parameter = StressParameter{.name = "length, or its inverse", .unit = "", .easy = 1.0, .hard = 1e30, .steps = 11},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
