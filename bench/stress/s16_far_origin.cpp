// S16: the same view far from the world's origin. Positions relative to the camera lose nothing, so that the error may
// not follow the distance.
#include "bench/stress/case.h"
#include "bench/stress/far_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr std::string_view kOfAxis = "of";
constexpr int kSide = 48;
constexpr double kDarkest = 1e-2;  // a hundredth of what is lit
constexpr double kTimesOrigin = 2.0;

StressMeasurement picture_error(Drawing& drawing) {
    const PictureErrors errors = picture_errors(drawing.reference(), drawing.draw(), kDarkest);
    return {.error = errors.p999, .non_finite = errors.non_finite, .where = errors.where()};
}

// Of what shading reads back, relative to the distance from the eye.
StressMeasurement position_error(Drawing& drawing) {
    const std::vector<ReferenceSurface> exact = drawing.surfaces();
    const std::vector<DecodedSurface> decoded = drawing.decoded();
    StressMeasurement found;
    for (size_t i = 0; i < exact.size(); ++i) {
        if (!exact[i].covered || !decoded[i].covered) continue;
        const glm::dvec3 off = glm::dvec3(decoded[i].position) - exact[i].position;
        const double error = glm::length(off) / glm::length(exact[i].position);
        if (!std::isfinite(error)) {
            ++found.non_finite;
        } else if (error > found.error) {
            const size_t width = static_cast<size_t>(drawing.width());
            found.error = error;
            found.where = fmt::format("pixel ({}, {})", i % width, i / width);
        }
    }
    return found;
}

StressMeasurement measure(Drawing& drawing, const FarScene::Place& place, bool of_position) {
    drawing.set_camera(place.camera);
    drawing.set_lights(place.lights);
    return of_position ? position_error(drawing) : picture_error(drawing);
}

std::vector<ArmBlock> arms() {
    ArmBlock pictures = every_path(), positions = every_layout();
    pictures.push_back({std::string(kOfAxis), {"picture"}});
    positions.push_back({std::string(kOfAxis), {"position"}});
    return {pictures, positions};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto far = std::make_shared<FarScene>();
    const auto drawing = std::make_shared<Drawing>(bench, arm, far->scene(), kSide, kSide);
    const bool of_position = arm.get(kOfAxis) == "position";
    const double at_origin = measure(*drawing, far->at_origin(), of_position).error;
    return [far, drawing, of_position, at_origin](double distance) {
        StressMeasurement found = measure(*drawing, far->at(distance), of_position);
        found.bound = kTimesOrigin * at_origin;
        return found;
    };
}

}  // namespace

extern const StressCase stress_far_origin{
    .id = "S16",
    .summary = "scene and camera far from the world's origin",
    .measures = "p99.9 error of the picture, or largest error of decoded positions over their distance",
    .unit = "rel",
    .bound_source = "twice the arm's own error at the origin",
    .failure = "geometry trembles and shadows tear far out in large worlds",
    .parameter = StressParameter{.name = "distance from the origin",
                                 .unit = "units",
                                 .easy = kNearestOrigin,
                                 .hard = kFarthestOrigin,
                                 .steps = 5},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
