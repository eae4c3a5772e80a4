#include "bench/stress/mirror_planes.h"

#include "bench/stress/test_scenes.h"

#include <glm/ext/matrix_transform.hpp>

#include <cmath>

namespace lightsweep {
namespace {

constexpr double kEyeHeight = 1.0;
constexpr double kOverhang = 1.25;  // of a plane over the view: corners are then whole eighths of a pixel outside
constexpr double kApart = 20.0;
constexpr double kRadius = 100.0;

// From a frame in which planes face +z and stand along x.
glm::dmat3 askew() { return glm::dmat3(glm::rotate(glm::dmat4(1.0), 1.0, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)))); }

glm::dvec3 in_world(size_t index, const glm::dvec3& local) {
    return askew() * (local + glm::dvec3(kApart * static_cast<double>(index), 0.0, 0.0));
}

}  // namespace

Scene mirror_planes(std::span<const MirrorPlane> planes) {
    Scene scene;
    scene.key = "mirror planes";
    for (size_t i = 0; i < planes.size(); ++i) {
        const Geometry quad = make_shape(QuadShape{.size = glm::dvec2(2.0 * kOverhang * planes[i].half_view)});
        glm::dmat4 transform(askew());
        transform[3] = glm::dvec4(in_world(i, glm::dvec3(0.0)), 1.0);
        add_instance(scene, quad, planes[i].material, transform);
    }
    scene.camera = mirror_camera(planes, 0);
    declare_light_kinds(scene, true, false, false);
    return scene;
}

Camera mirror_camera(std::span<const MirrorPlane> planes, size_t index) {
    return {.eye = in_world(index, {0.0, 0.0, kEyeHeight}),
            .target = in_world(index, glm::dvec3(0.0)),
            .up = askew() * glm::dvec3(0.0, 1.0, 0.0),
            .fov_y_deg = glm::degrees(2.0 * std::atan(planes[index].half_view)),
            .near_distance = 0.1,
            .far_distance = 10.0};
}

Light mirror_light(size_t index, double across) {
    return point_light(in_world(index, {across, 0.5 * across, kMirrorLightHeight}), kRadius, glm::dvec3(1.0));
}

}  // namespace lightsweep
