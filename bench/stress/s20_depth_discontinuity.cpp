// Tiles whose surfaces lie far apart: planks in front of each other, from the near plane to the far plane, with lights
// at each and sky between. Lists that end where a tile's surfaces do, and slices at both ends of the view, must lose no
// light; where a picture shows nothing but sky, nothing is lit.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/random.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr double kNear = 1.0, kFar = 50000.0;
constexpr double kEnds = 2e-5;  // how close planks are to both planes, of their distance
constexpr int kPlanks = 80;
constexpr double kDarkest = 0.002;  // a hundredth of what a plank reflects under its light
const glm::dvec3 kEye(5.0, 3.0, 7.0);

// Planks of 3 to 10 pixels all over the picture, their distances spread evenly over powers of two, the nearest and the
// farthest at the planes that clip. Each has a light in front of it, a few of all sizes shine between.
Scene planks() {
    Scene scene;
    scene.key = "planks";
    scene.background = {0.25, 0.5, 1.0};
    scene.camera = {
        .eye = kEye, .target = kEye - glm::dvec3(0.0, 0.0, 1.0), .near_distance = kNear, .far_distance = kFar};
    const double tan_y = std::tan(glm::radians(scene.camera.fov_y_deg) / 2.0), tan_x = tan_y * kWidth / kHeight;
    Random random(20);
    const auto place = [&](double z) {
        return kEye + z * glm::dvec3(random.uniform(-tan_x, tan_x), random.uniform(-tan_y, tan_y), -1.0);
    };
    for (int i = 0; i < kPlanks; ++i) {
        const double first = kNear * (1.0 + kEnds), last = kFar * (1.0 - kEnds);
        const double z = first * std::pow(last / first, i / (kPlanks - 1.0));
        const glm::dvec3 center = place(z);
        const double size = z * random.uniform(0.08, 0.25);
        glm::dmat4 transform(1.0);
        for (int axis = 0; axis < 2; ++axis) transform[axis][axis] = size;
        transform[3] = glm::dvec4(center, 1.0);
        if (i == 0) {
            const Material material{.name = "matt", .model = ShadingModel::lambert, .base_color = {0.8F, 0.5F, 0.3F}};
            add_instance(scene, make_shape(QuadShape{}), material, transform);
        } else {
            add_instance(scene, 0, transform);
        }
        const double radius = 0.4 * z;
        scene.lights.fixed.push_back(
            point_light(center + glm::dvec3(0.0, 0.0, 0.1 * z), radius, glm::dvec3(0.05 * radius * radius)));
    }
    for (double z = 2.0 * kNear; z < kFar; z *= 4.0) {
        scene.lights.fixed.push_back(spot_light(place(z), {0.2, 0.1, -1.0}, z, 35.0, glm::dvec3(0.2 * z * z)));
    }
    return scene;
}

bool shows_only(const Image& image, const glm::dvec3& color) {
    for (size_t i = 0; i < image.rgb.size(); ++i) {
        if (image.rgb[i] != static_cast<float>(color[static_cast<int>(i % 3)])) return false;
    }
    return true;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto drawing = std::make_shared<Drawing>(bench, arm, planks(), kWidth, kHeight);
    return [drawing](double) {
        const auto errors = picture_errors(drawing->reference(), drawing->draw(), kDarkest);
        StressMeasurement found{.error = errors.max, .non_finite = errors.non_finite, .where = errors.where()};
        Camera away = drawing->scene().camera;
        away.target = kEye + glm::dvec3(0.0, 0.0, 1.0);
        drawing->set_camera(away);
        if (!shows_only(drawing->draw(), drawing->scene().background)) {
            found.error = std::max(found.error, 1.0);
            found.where = "the sky is lit";
        }
        drawing->set_camera(drawing->scene().camera);
        return found;
    };
}

std::vector<ArmBlock> arms() { return {with_list_builders(every_path())}; }

}  // namespace

extern const StressCase stress_depth_discontinuity{
    .id = "S20",
    .summary = "planks before planks, from the near to the far plane, with lights at each and sky between; sky alone",
    .measures = "worst pixel against double precision, of what is brighter than a lit plank's hundredth; 1: sky is lit",
    .unit = "rel",
    .bound = 1800 * 0x1p-24,
    .bound_source =
        "a hundred roundings of 2^-24, 18 times over: at 1 % of a light's brightness the window (1 - q)^2, q = (d / "
        "r)^4, "
        "has q = 0.9, and takes 2 q / (1 - q) times q's error",
    .failure = "halos and square cut-outs around things in front of something far",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
