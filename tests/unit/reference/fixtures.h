// Single surfaces and small scenes whose light can be worked out by hand.
#pragma once

#include "renderer/base/random.h"
#include "renderer/reference/reference.h"

#include <cmath>
#include <numbers>
#include <ostream>

namespace glm {
inline void PrintTo(const dvec3& v, std::ostream* out) { *out << '(' << v.x << ", " << v.y << ", " << v.z << ')'; }
}  // namespace glm

namespace lightsweep {

inline constexpr double kPi = std::numbers::pi;

/// The radiance of one surface, the eye at the origin.
inline glm::dvec3 radiance(const ReferenceSurface& surface, std::span<const Light> lights, const Scene& scene = {}) {
    Camera at_origin{.eye = glm::dvec3(0.0)};
    return shade_reference(scene, std::span(&surface, 1), 1, 1, at_origin, lights).front();
}

/// Faces up at the origin of its own space, seen along `to_eye` (unit) from `distance` away.
inline ReferenceSurface surface_seen_from(const glm::dvec3& to_eye, double distance, ShadingModel model) {
    ReferenceSurface s;
    s.position = -distance * to_eye;
    s.normal = {0, 1, 0};
    s.base_color = {0.8, 0.5, 0.25};
    s.specular = {0.3, 0.2, 0.1};
    s.roughness = 0.5;
    s.model = model;
    s.covered = true;
    return s;
}

/// Unit irradiance from `to_light`.
inline Light sun(const glm::dvec3& to_light, double irradiance = 1.0) {
    return {.kind = LightKind::directional, .direction = -to_light, .color = glm::dvec3(irradiance)};
}

inline glm::dvec3 random_direction(Random& random) {
    const double z = random.uniform(-1.0, 1.0);
    const double angle = random.uniform(0.0, 2.0 * kPi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

/// In the upper half (y > 0), not closer to the horizon than 0.05.
inline glm::dvec3 random_upward(Random& random) {
    glm::dvec3 direction;
    do direction = random_direction(random);
    while (direction.y < 0.05);
    return direction;
}

/// A wavy surface of all three models around the origin, three units from the eye at (0, 0, 3); some of it uncovered.
inline std::vector<ReferenceSurface> wavy_surfaces(int width, int height) {
    std::vector<ReferenceSurface> surfaces;
    Random random(5);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double u = 4.0 * x / width - 2.0, v = 2.0 - 4.0 * y / height;
            ReferenceSurface s;
            s.covered = (x + 3 * y) % 17 != 0;
            s.position = glm::dvec3(u, v, 0.3 * std::sin(3.0 * u) * std::cos(2.0 * v)) - glm::dvec3(0, 0, 3);
            s.normal = glm::normalize(glm::dvec3(-0.9 * std::cos(3.0 * u) * std::cos(2.0 * v),
                                                 0.6 * std::sin(3.0 * u) * std::sin(2.0 * v), 1.0));
            s.base_color = {random.uniform(), random.uniform(), random.uniform()};
            s.specular = glm::dvec3(random.uniform());
            s.emissive = glm::dvec3(0.1 * random.uniform());
            s.roughness = random.uniform();
            s.metallic = random.uniform();
            s.model = static_cast<ShadingModel>(random.index(kShadingModelCount));
            surfaces.push_back(s);
        }
    }
    return surfaces;
}

/// Points, spots and suns around wavy_surfaces(), most of them small.
inline std::vector<Light> many_lights(int count) {
    std::vector<Light> lights;
    Random random(9);
    for (int i = 0; i < count; ++i) {
        Light light{.position = {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5), random.uniform(0.1, 1.0)},
                    .direction = random_direction(random),
                    .color = {random.uniform(), random.uniform(), random.uniform()},
                    .radius = random.uniform(0.3, 1.5),
                    .inner_deg = random.uniform(5.0, 30.0),
                    .outer_deg = random.uniform(40.0, 80.0)};
        if (i % 3 == 1) light.kind = LightKind::spot;
        if (i % 16 == 2) light.kind = LightKind::directional;
        lights.push_back(light);
    }
    return lights;
}

inline constexpr Camera kWavyCamera{.eye = {0.0, 0.0, 3.0}};

}  // namespace lightsweep
