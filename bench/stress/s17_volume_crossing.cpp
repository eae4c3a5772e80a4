// The eye goes through the surface of a light's volume. Where geometry stands for what a light reaches, the near plane
// cuts it open there, faces turn their backs, and a stencil counts wrong: but the picture is that of a full-screen
// pass.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace lightsweep {
namespace {

constexpr int kSizePx = 32;
constexpr double kFar = 20.0;
constexpr double kRadius = 3.0, kVastRadius = 5.0 * kFar, kConeDeg = 40.0;
const glm::dvec3 kEye(0.3, -0.2, 0.1);
// The faces of the enclosing sphere (renderer/pass/volume_meshes.h) touch it in the directions (+-1, +-1, +-1), so that
// the eye goes through the mesh where it goes through the sphere.
const glm::dvec3 kAhead = glm::normalize(glm::dvec3(1.0, 1.0, 1.0));
const glm::dvec3 kAside = glm::normalize(glm::dvec3(1.0, 1.0, -1.0));

// Of what lies at half a radius, nearly: errors where the light runs out count against it.
constexpr double kDarkest = 0.01;

// A closed room, so that there is a surface wherever one looks, with things between the eye and its corner.
Scene room() {
    Scene scene;
    scene.key = "room";
    const Material material{
        .name = "matt", .model = ShadingModel::lambert, .base_color = {0.8F, 0.5F, 0.3F}, .double_sided = true};
    add_instance(scene, make_shape(BoxShape{.size = glm::dvec3(8.0)}), material);
    for (const auto& [distance, radius] : {std::pair{0.3, 0.1}, {1.4, 0.5}}) {
        glm::dmat4 place(1.0);
        place[3] = glm::dvec4(kEye + distance * glm::normalize(kAhead + 0.2 * kAside), 1.0);
        add_instance(scene, make_shape(SphereShape{.radius = radius}), material, place);
    }
    scene.camera = {
        .eye = kEye, .target = kEye + kAhead, .fov_y_deg = 90.0, .near_distance = 0.05, .far_distance = kFar};
    declare_light_kinds(scene, true, true, false);
    return scene;
}

// Around the eye, ahead of it, beside it and behind it: spheres whose surface is as near to the eye as `gap` says, as a
// part of their radius; negative: the eye is inside.
void add_points(double radius, double gap, std::vector<Light>& lights) {
    for (const glm::dvec3& way : {kAhead, kAside, -kAhead}) {
        lights.push_back(point_light(kEye + radius * (1.0 + gap) * way, radius, glm::dvec3(radius * radius)));
    }
}

// The same of cones: through the cap from either side, through the side, and past the apex.
void add_spots(double gap, std::vector<Light>& lights) {
    const auto add = [&](const glm::dvec3& from_eye, const glm::dvec3& direction) {
        lights.push_back(spot_light(kEye + from_eye, direction, kRadius, kConeDeg, glm::dvec3(kRadius * kRadius)));
    };
    add(-kRadius * (1.0 + gap) * kAhead, kAhead);
    add(kRadius * (1.0 + gap) * kAhead, -kAhead);
    // Where a flat side of the enclosing cone touches it: half-way between two of its ten edges.
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(1.0, 0.0, 0.0), kAhead));
    const double angle = glm::pi<double>() / 10.0;
    const glm::dvec3 out = std::cos(angle) * right + std::sin(angle) * glm::cross(kAhead, right);
    const double along = 0.5 * kRadius;
    add(-along * (kAhead + std::tan(glm::radians(kConeDeg)) * (1.0 + gap) * out), kAhead);
    add(gap * kRadius * kAhead, kAhead);
    add(gap * kRadius * kAhead, -kAhead);
}

std::vector<Light> crossing_lights(const std::string& kind, double gap) {
    std::vector<Light> lights;
    if (kind == "spot") {
        add_spots(gap, lights);
    } else {
        add_points(kind == "vast" ? kVastRadius : kRadius, gap, lights);
    }
    return lights;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto drawing = std::make_shared<Drawing>(bench, arm, room(), kSizePx, kSizePx);
    return [drawing, surfaces = drawing->surfaces(), kind = arm.get("light")](double parameter) {
        StressMeasurement found;
        for (const double gap : {parameter, -parameter}) {
            for (const Light& light : crossing_lights(kind, gap)) {
                drawing->set_lights({light});
                const auto errors = picture_errors(drawing->reference(surfaces), drawing->draw(), kDarkest);
                found.non_finite += errors.non_finite;
                if (errors.max <= found.error) continue;
                found.error = errors.max;
                found.where = errors.where() + (gap < 0.0 ? ", eye inside" : ", eye outside");
            }
        }
        return found;
    };
}

std::vector<ArmBlock> arms() {
    ArmBlock block = every_path();
    block.push_back({"light", {"point", "spot", "vast"}});
    return {block};
}

}  // namespace

extern const StressCase stress_volume_crossing{
    .id = "S17",
    .summary = "the eye goes through the surface of a light's volume, of a sphere, a cone, and one larger than far",
    .measures = "worst pixel against double precision, of what is brighter than 1 % of a surface that the light faces",
    .unit = "rel",
    .bound = 1800 * 0x1p-24,
    .bound_source =
        "a hundred roundings of 2^-24, 18 times over: at 1 % of a light's brightness the window (1 - q)^2, q = (d / "
        "r)^4, "
        "has q = 0.9, and takes 2 q / (1 - q) times q's error",
    .failure = "the picture flashes dark, or bright discs appear, as the camera walks into a light",
    .parameter = StressParameter{.name = "distance from the volume's surface over its radius",
                                 .unit = "",
                                 .easy = 0.1,
                                 .hard = 1e-6,
                                 .steps = 6},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
