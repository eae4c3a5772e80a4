// More and more lights at one place, until the cells' lists hold far more than there was room for at first. No light
// may fall out of its list without a word: lists grow, or the device refuses and says so. With no lights, lists are
// empty.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/error.h"
#include "renderer/base/random.h"
#include "renderer/paths/paths.h"

#include <algorithm>
#include <memory>

namespace lightsweep {
namespace {

// Six tiles of 16 px: with the most lights they want 98,304 places, and a compute shader's lists begin with 65,536.
constexpr int kWidth = 33, kHeight = 17;
constexpr int kMostLights = 16384;

// Each reaches every pixel, with much the same share of what arrives there.
std::vector<Light> crowd(int count) {
    Random random(19);
    const auto shift = [&] { return random.uniform(-0.02, 0.02); };
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(shift(), shift(), 0.8 + shift());
        lights.push_back(point_light(place, 6.0, glm::dvec3(4.0 / count)));
    }
    return lights;
}

// The path that evaluates every light for the same surfaces: the same sums in the same order.
StressArm brute_force(const StressArm& arm) {
    const bool deferred = find_path(arm.get(kPathAxis)).uses_layout;
    StressArm::Choices choices{{std::string(kPathAxis), deferred ? "deferred" : "forward_prepass"}};
    for (const std::string_view axis : {kLayoutAxis, kHdrAxis}) {
        if (!arm.get(axis).empty()) choices.emplace_back(axis, arm.get(axis));
    }
    return StressArm(choices);
}

float brightest(const Image& image) { return std::ranges::max(image.rgb); }

StressTrial begin(Workbench& bench, const StressArm& arm) {
    Scene scene =
        facing_plane({.name = "matt", .model = ShadingModel::lambert, .base_color = glm::vec3(0.8F)}, 6.0, 2.0);
    declare_light_kinds(scene, true, false, false);
    const auto listed = std::make_shared<Drawing>(bench, arm, scene, kWidth, kHeight);
    const auto plain = std::make_shared<Drawing>(bench, brute_force(arm), scene, kWidth, kHeight);
    return [listed, plain](double parameter) {
        StressMeasurement found;
        const auto lights = crowd(static_cast<int>(parameter));
        plain->set_lights(lights);
        const Image expected = plain->draw();
        listed->set_lights(lights);
        try {
            const auto errors = picture_errors(expected, listed->draw(), 0.01 * brightest(expected));
            found = {.error = errors.max, .non_finite = errors.non_finite, .where = errors.where()};
        } catch (const EnvironmentError& error) {
            found = {.error = 1.0, .limit = error.what()};
        }
        listed->set_lights({});
        const float left = brightest(listed->draw());
        if (left > 0.0F) found = {.error = 1.0, .where = "no lights: a pixel is lit"};
        return found;
    };
}

std::vector<ArmBlock> arms() { return {with_list_builders(every_listing_path())}; }

}  // namespace

extern const StressCase stress_list_lengths{
    .id = "S19",
    .summary = "1 to 16,384 lights at one place, more than any list holds at first; then none",
    .measures = "worst pixel against the path that evaluates every light",
    .unit = "rel",
    .bound = 0.5 / kMostLights,
    .bound_source = "half of what one of 16,384 equal lights gives: none may be lost",
    .failure = "lights vanish, tile by tile, where they crowd",
    .parameter =
        StressParameter{
            .name = "lights in a cell", .unit = "lights", .easy = 1.0, .hard = kMostLights, .steps = 8, .whole = true},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
