// Lights and cameras that spare no special case.
#pragma once

#include "renderer/base/random.h"
#include "renderer/frame/needs.h"
#include "renderer/scene/scene.h"

#include <cmath>
#include <vector>

namespace lightsweep {

inline glm::dvec3 random_place(Random& random, const Bounds& bounds, double margin) {
    glm::dvec3 place;
    for (int k = 0; k < 3; ++k) place[k] = random.uniform(bounds.low[k] - margin, bounds.high[k] + margin);
    return place;
}

inline glm::dvec3 random_direction(Random& random) {
    const auto any = [&] { return random.uniform(-1.0, 1.0); };
    return glm::normalize(glm::dvec3(any(), any(), any()));
}

/// Lights of all sizes around what the camera sees: dots, volumes that hold the camera, everything. Half of them are
/// spots where the scene's shaders know spots.
inline std::vector<Light> unruly_lights(const Scene& scene, int count, uint64_t seed) {
    Random random(seed);
    const Bounds bounds = scene.world_bounds();
    const double extent = glm::length(bounds.size());
    const bool spots = scene_needs(scene).spot_lights;
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        Light light;
        light.position = random_place(random, bounds, 0.1 * extent);
        if (i % 7 == 0) light.position = scene.camera.eye + 0.01 * extent * glm::dvec3(random.uniform(), 0.1, -0.2);
        light.radius = extent * std::pow(10.0, random.uniform(-3.0, 0.3));
        light.color = glm::dvec3(random.uniform(), random.uniform(), random.uniform()) * light.radius * light.radius;
        if (spots && i % 2 == 1) {
            light.kind = LightKind::spot;
            light.outer_deg = random.uniform(1.0, 89.0);
            light.inner_deg = 0.5 * light.outer_deg;
            light.direction = random_direction(random);
        }
        lights.push_back(light);
    }
    return lights;
}

/// The scene's camera, moved to anywhere in or around the scene, inside of things too, and turned any way.
inline Camera unruly_camera(const Scene& scene, Random& random) {
    Camera camera = scene.camera;
    const Bounds bounds = scene.world_bounds();
    camera.eye = random_place(random, bounds, 0.1 * glm::length(bounds.size()));
    camera.target = camera.eye + random_direction(random);
    camera.fov_y_deg = random.uniform(20.0, 100.0);
    return camera;
}

}  // namespace lightsweep
