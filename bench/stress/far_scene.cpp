#include "bench/stress/far_scene.h"

#include "bench/stress/test_scenes.h"

#include <glm/ext/matrix_transform.hpp>

namespace lightsweep {
namespace {

// No distance along it is a sum of few powers of two: no coordinate is exact in 32 bits, nor in 64.
const glm::dvec3 kWay = glm::normalize(glm::dvec3(0.61, 0.23, -0.76));

struct Shape {
    Geometry geometry;
    Material material;
    glm::dmat4 transform;
};

std::vector<Shape> shapes() {
    const glm::dmat4 one(1.0);
    const Material floor{.name = "floor", .base_color = {0.6F, 0.5F, 0.4F}, .roughness = 0.7F};
    const Material metal{.name = "metal", .base_color = {0.9F, 0.7F, 0.3F}, .roughness = 0.4F, .metallic = 1.0F};
    const Material stone{.name = "stone", .base_color = {0.3F, 0.5F, 0.7F}, .roughness = 0.5F};
    return {{make_shape(PlaneShape{.size = glm::dvec2(8.0)}), floor, glm::translate(one, {0.0, -0.8, 0.0})},
            {make_shape(SphereShape{.radius = 0.8, .segments = 48, .rings = 24}), metal,
             glm::translate(one, {-0.7, 0.0, 0.0})},
            {make_shape(BoxShape{}), stone, glm::rotate(glm::translate(one, {0.9, -0.2, 0.3}), 0.6, {0.2, 1.0, 0.1})}};
}

std::vector<Light> lights_around(const glm::dvec3& place) {
    return {point_light(place + glm::dvec3(1.5, 2.0, 1.0), 8.0, {6.0, 5.0, 4.0}),
            point_light(place + glm::dvec3(-2.0, 1.0, 1.5), 6.0, {2.0, 3.0, 5.0}),
            spot_light(place + glm::dvec3(0.0, 3.0, 0.5), {0.1, -1.0, -0.2}, 6.0, 40.0, {8.0, 8.0, 8.0})};
}

FarScene::Place looking_at(const glm::dvec3& place) {
    return {.camera = {.eye = place + glm::dvec3(0.4, 1.2, 3.1),
                       .target = place + glm::dvec3(0.0, -0.1, 0.0),
                       .near_distance = 0.1,
                       .far_distance = 20.0},
            .lights = lights_around(place)};
}

}  // namespace

FarScene::FarScene() {
    scene_.key = "far";
    std::vector<Shape> parts = shapes();
    for (const Shape& shape : parts) add_instance(scene_, shape.geometry, shape.material, shape.transform);
    for (size_t i = 0; i < distances_.size(); ++i) {
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), distances_[i] * kWay);
        for (size_t k = 0; k < parts.size(); ++k) {
            add_instance(scene_, static_cast<uint32_t>(k), moved * parts[k].transform);
        }
    }
    scene_.camera = at_origin().camera;
    scene_.lights.fixed = at_origin().lights;
}

FarScene::Place FarScene::at_origin() const { return looking_at(glm::dvec3(0.0)); }

FarScene::Place FarScene::at(double distance) const {
    return looking_at(distances_[distances_.nearest(distance)] * kWay);
}

}  // namespace lightsweep
