// S31: the camera takes a tiny step sideways, far from the origin. From one picture to the next a pixel may change by
// as much as the exact one, and besides by what each of the two was off.
#include "bench/stress/case.h"
#include "bench/stress/far_scene.h"
#include "bench/stress/stored_surfaces.h"
#include "bench/stress/vector_math.h"
#include "renderer/frame/frame.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr std::string_view kStepAxis = "step";
constexpr int kSide = 48;
constexpr double kDarkest = 1e-2;      // a hundredth of what is lit
constexpr double kTimesOrigin = 2.0;   // as in S16
constexpr double kSeen = 1.0 / 255.0;  // a step of a display

// A picture, and what it should be; from one visibility, so that an edge moves in both at once.
struct Shot {
    Image picture;
    std::vector<glm::dvec3> exact;
};

// Before a step and after it.
struct Shots {
    Shot before, after;
};

Shot take(Drawing& drawing, const Camera& camera) {
    drawing.set_camera(camera);
    return {drawing.draw(), drawing.reference()};
}

// As exact shading of what the layout stores would show it.
Shot take_stored(Drawing& drawing, const Camera& camera) {
    drawing.set_camera(camera);
    const auto surfaces = drawing.surfaces();
    const auto stored = drawing.reference(stored_surfaces(drawing, surfaces).surfaces);
    return {to_image(stored, kSide, kSide), drawing.reference(surfaces)};
}

glm::dvec3 drawn(const Shot& shot, size_t pixel) {
    return {shot.picture.rgb[3 * pixel], shot.picture.rgb[3 * pixel + 1], shot.picture.rgb[3 * pixel + 2]};
}

// The largest change of a pixel that the exact one does not make, over the brighter of the two.
StressMeasurement jitter(const Shots& shots) {
    const Shot &before = shots.before, &after = shots.after;
    StressMeasurement found{.non_finite = count_non_finite(before.picture) + count_non_finite(after.picture)};
    for (size_t i = 0; i < before.exact.size(); ++i) {
        const glm::dvec3 exact = after.exact[i] - before.exact[i], change = drawn(after, i) - drawn(before, i);
        const double brightness = std::max({largest(before.exact[i]), largest(after.exact[i]), kDarkest});
        if (const double error = largest(change - exact) / brightness; error > found.error) {
            found.error = error;
            found.where = fmt::format("pixel ({}, {})", i % kSide, i / kSide);
        }
    }
    return found;
}

// A thousandth of a unit, or of a pixel where the camera looks.
double step_length(const std::string& step, const Camera& camera) {
    if (step == "unit") return 1e-3;
    const double height =
        2.0 * glm::length(camera.target - camera.eye) * std::tan(0.5 * glm::radians(camera.fov_y_deg));
    return 1e-3 * height / kSide;
}

Camera stepped(Camera camera, double length) {
    const glm::dvec3 way = length * camera_basis(camera).right;
    camera.eye += way;
    camera.target += way;
    return camera;
}

std::vector<ArmBlock> arms() {
    ArmBlock layouts = every_layout();
    layouts.push_back({std::string(kStepAxis), {"unit"}});
    return {layouts,
            {{std::string(kPathAxis), {"forward", "deferred", "visibility", "light_prepass"}},
             {std::string(kLayoutAxis), {"float32"}},
             {std::string(kHdrAxis), {"rgba32f"}},
             {std::string(kStepAxis), {"unit", "pixel"}}}};
}

Shots take_step(Drawing& drawing, const FarScene::Place& place, double step) {
    drawing.set_lights(place.lights);
    return {take(drawing, place.camera), take(drawing, stepped(place.camera, step))};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto far = std::make_shared<FarScene>();
    const auto drawing = std::make_shared<Drawing>(bench, arm, far->scene(), kSide, kSide);
    const double step = step_length(arm.get(kStepAxis), far->at_origin().camera);
    const Shots at_origin = take_step(*drawing, far->at_origin(), step);
    // What each of two pictures is off at the origin, together.
    const double off = picture_errors(at_origin.before.exact, at_origin.before.picture, kDarkest).max +
                       picture_errors(at_origin.after.exact, at_origin.after.picture, kDarkest).max;
    std::optional<double> law;
    if (packs(arm)) {
        const Camera& camera = far->at_origin().camera;
        law = jitter({take_stored(*drawing, camera), take_stored(*drawing, stepped(camera, step))}).error;
    }
    return [far, drawing, step, off, law](double distance) {
        StressMeasurement found = jitter(take_step(*drawing, far->at(distance), step));
        found.law = law;
        found.bound = std::min(kTimesOrigin * off, kSeen);
        return found;
    };
}

}  // namespace

extern const StressCase stress_small_steps{
    .id = "S31",
    .summary = "the camera steps aside by a thousandth, far from the origin",
    .measures = "largest change of a pixel beyond the exact one's, over its brightness",
    .unit = "rel",
    .bound = kSeen,
    .bound_source =
        "a display's step of 1/255; or twice what two pictures are off at the origin, where that is less; law, of "
        "layouts "
        "that pack: the same step at the origin, exactly shaded from what the layout stores",
    .failure = "still pictures shimmer; edges and highlights crawl when the camera moves slowly",
    .parameter = StressParameter{.name = "distance from the origin",
                                 .unit = "units",
                                 .easy = kNearestOrigin,
                                 .hard = kFarthestOrigin,
                                 .steps = 5},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
