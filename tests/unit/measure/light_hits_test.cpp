#include "bench/measure/light_hits.h"

#include "renderer/base/random.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

const glm::dvec3 kEye(100.0, -50.0, 3.0);

ReferenceSurface surface_at(const glm::dvec3& world) {
    ReferenceSurface surface;
    surface.position = world - kEye;
    surface.covered = true;
    return surface;
}

glm::dvec3 random_point(Random& random, double extent) {
    return {random.uniform(-extent, extent), random.uniform(-extent, extent), random.uniform(-extent, extent)};
}

Light random_light(Random& random, LightKind kind, double radius) {
    Light light{.kind = kind, .position = random_point(random, 12.0), .radius = radius};
    light.direction = glm::normalize(random_point(random, 1.0));
    light.outer_deg = random.uniform(5.0, 85.0);
    light.inner_deg = 0.5 * light.outer_deg;
    return light;
}

// By angle, from world positions: not as the code does it.
bool reaches(const Light& light, const glm::dvec3& world) {
    if (light.kind == LightKind::directional) return true;
    const glm::dvec3 way = world - light.position;
    if (glm::length(way) >= light.radius) return false;
    const double angle = std::acos(glm::dot(glm::normalize(way), light.direction)) * 180.0 / std::numbers::pi;
    return light.kind == LightKind::point || angle < light.outer_deg;
}

TEST(LightHits, equal_a_count_over_every_pixel_and_light) {
    for (const double radius : {0.05, 1.0, 4.0, 100.0}) {
        Random random(7);
        std::vector<glm::dvec3> points;
        std::vector<ReferenceSurface> surfaces;
        for (int i = 0; i < 700; ++i) {
            points.push_back(random_point(random, 10.0));
            surfaces.push_back(surface_at(points.back()));
            if (i % 7 == 0) surfaces.emplace_back();  // background
        }
        std::vector<Light> lights;
        for (int i = 0; i < 90; ++i) {
            const auto kind = static_cast<LightKind>(i % 30 == 0 ? 2 : i % 2);
            lights.push_back(random_light(random, kind, radius * random.uniform(0.2, 2.0)));
        }
        int64_t expected = 0;
        for (const auto& light : lights) {
            for (const auto& point : points) expected += reaches(light, point) ? 1 : 0;
        }
        EXPECT_EQ(count_light_hits(surfaces, lights, kEye), expected) << "radius " << radius;
    }
}

TEST(LightHits, of_a_picture_without_depth_or_without_a_surface) {
    // All pixels on one plane, then on one point: a grid without an extent.
    std::vector<ReferenceSurface> plane;
    for (int i = 0; i < 100; ++i) {
        const int row = i / 10;
        plane.push_back(surface_at({i % 10, row, 0.0}));
    }
    const Light light{.position = {4.0, 4.0, 0.5}, .radius = 1.2};
    // 1.2^2 - 0.5^2 = 1.19: the pixel below and its four neighbours.
    EXPECT_EQ(count_light_hits(plane, std::vector{light}, kEye), 5);
    EXPECT_EQ(count_light_hits(std::vector(3, surface_at({4.0, 4.0, 0.0})), std::vector{light}, kEye), 3);
    EXPECT_EQ(count_light_hits(std::vector<ReferenceSurface>(9), std::vector{light}, kEye), 0);
    EXPECT_EQ(count_light_hits(plane, {}, kEye), 0);
}

TEST(LightHits, a_light_that_gives_nothing_reaches_nothing) {
    const std::vector<ReferenceSurface> one{surface_at({0.0, 0.0, 0.0})};
    EXPECT_EQ(count_light_hits(one, std::vector{Light{.color = glm::dvec3(0.0), .radius = 5.0}}, kEye), 0);
    EXPECT_EQ(count_light_hits(one, std::vector{Light{.radius = 0.0}}, kEye), 0);
}

}  // namespace
}  // namespace lightsweep
