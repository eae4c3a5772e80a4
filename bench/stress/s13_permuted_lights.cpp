// S13: the same lights in another order.
#include "bench/stress/case.h"
#include "bench/stress/hdr_target.h"
#include "bench/stress/test_scenes.h"

#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr int kSize = 48;
constexpr size_t kMostLights = 256;
constexpr double kDarkest = 1e-2;  // radiance; below it short floats have less than their bits
constexpr uint64_t kLightSeed = 13, kOrderSeed = 31;

std::vector<Light> some_lights() {
    Random random(kLightSeed);
    std::vector<Light> lights;
    for (size_t i = 0; i < kMostLights; ++i) {
        const double x = random.uniform(-2.0, 2.0), y = random.uniform(-2.0, 2.0), z = random.uniform(0.2, 1.5);
        const double red = random.uniform(0.1, 1.0), green = random.uniform(0.1, 1.0), blue = random.uniform(0.1, 1.0);
        lights.push_back(point_light({x, y, z}, random.uniform(0.5, 4.0), {red, green, blue}));
    }
    return lights;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    Scene scene = facing_plane({.name = "plane", .base_color = {0.8F, 0.5F, 0.2F}, .roughness = 0.5F}, 4.0, 3.0);
    declare_light_kinds(scene, true, false, false);
    const auto drawing = std::make_shared<Drawing>(bench, arm, std::move(scene), kSize, kSize);
    return [drawing, arm, all = some_lights()](double parameter) {
        const auto count = static_cast<size_t>(parameter);
        const std::vector<Light> lights(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
        drawing->set_lights(lights);
        const Image listed = drawing->draw();
        drawing->set_lights(shuffled(lights, kOrderSeed));
        const Image permuted = drawing->draw();
        const PictureErrors errors = picture_errors(listed, permuted, kDarkest);
        return StressMeasurement{.error = errors.max,
                                 .bound = 2.0 * hdr_rounding(arm, *drawing, count),
                                 .non_finite = errors.non_finite + count_non_finite(listed),
                                 .where = errors.where()};
    };
}

std::vector<ArmBlock> arms() {
    return {every_path(),
            {{std::string(kPathAxis),
              {"forward_multipass", "deferred", "deferred_scissor", "deferred_volumes", "light_prepass"}},
             {std::string(kLayoutAxis), {"float32"}},
             {std::string(kHdrAxis), {"rgba16f", "r11g11b10f"}}}};
}

}  // namespace

extern const StressCase stress_permuted_lights;
const StressCase stress_permuted_lights{
    .id = "S13",
    .summary = "the list of lights permuted",
    .measures = "one picture against the other",
    .unit = "rel",
    .bound = 0.0,
    .bound_source =
        "each order is within N roundings of the exact sum: N 2^-24 in registers, N steps of the format where lights "
        "are blended, and two steps where they are stored",
    .failure = "the picture changes when lights are sorted or culled another way",
    .parameter =
        StressParameter{.name = "lights", .unit = "", .easy = 2, .hard = kMostLights, .steps = 4, .whole = true},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
