#include "bench/stress/fuzz_bounds.h"

#include "bench/stress/vector_math.h"
#include "renderer/base/float_split.h"
#include "renderer/reference/reference.h"
#include "renderer/reference/triangle.h"
#include "renderer/reference/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr double kLeastRadius = 1e-18;  // of a light in a frame: its square is no zero

glm::dvec3 in_float(const glm::dvec3& v) {
    return {rounded_to_float(v.x), rounded_to_float(v.y), rounded_to_float(v.z)};
}

// A visible triangle relative to the eye, and how much what it carries differs over it.
struct SeenTriangle {
    glm::dvec3 corner, edge1, edge2;
    double position_range = 0.0, normal_range = 0.0;
    double cancellation = 1.0;  // of the products that make a normal, over what is left of them

    glm::dvec3 at(int k) const { return k == 0 ? corner : corner + (k == 1 ? edge1 : edge2); }
};

SeenTriangle seen_triangle(const Scene& scene, const Camera& camera, const VisibleTriangle& visible) {
    const Instance& instance = scene.instances[visible.instance];
    const PlacedInstance placed = place(instance, camera.eye);
    const auto vertices = corners(scene, scene.meshes[instance.mesh], visible.triangle);
    const PlacedTriangle triangle(vertices, placed);
    SeenTriangle seen{.corner = triangle.corner, .edge1 = triangle.edge1, .edge2 = triangle.edge2};
    glm::dvec3 normals[3];
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 own(vertices[k]->normal);
        normals[k] = placed.for_normals * own;
        const double length = std::max(glm::length(normals[k]), 1e-300);
        normals[k] /= length;
        double products = 0.0;
        for (int axis = 0; axis < 3; ++axis) products += glm::length(placed.for_normals[axis]) * std::abs(own[axis]);
        seen.cancellation = std::max(seen.cancellation, products / length);
    }
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        seen.position_range = std::max(seen.position_range, glm::length(seen.at(next) - seen.at(k)));
        seen.normal_range = std::max(seen.normal_range, glm::length(normals[next] - normals[k]));
    }
    return seen;
}

// What clipping leaves of the triangle: three corners, or four.
std::vector<glm::dvec3> before_near_plane(const SeenTriangle& t, const View& view, double near) {
    std::vector<glm::dvec3> corners;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 here = t.at(k), next = t.at((k + 1) % 3);
        const double distance = view.distance(here), next_distance = view.distance(next);
        if (distance >= near) corners.push_back(here);
        if ((distance >= near) == (next_distance >= near)) continue;
        corners.push_back(here + (next - here) * ((near - distance) / (next_distance - distance)));
    }
    return corners;
}

// The largest window coordinate over the least height of any triangle that a clipped one may be cut into.
double window_amplification(const std::vector<glm::dvec3>& corners, const View& view, double size) {
    if (corners.size() < 3) return std::numeric_limits<double>::infinity();
    std::vector<glm::dvec2> window;
    for (const glm::dvec3& corner : corners) window.push_back(view.window(corner));
    double longest = size, height = std::numeric_limits<double>::infinity();
    for (size_t a = 0; a < window.size(); ++a) {
        for (size_t b = a + 1; b < window.size(); ++b) {
            longest = std::max(longest, glm::length(window[b] - window[a]));
            for (size_t c = b + 1; c < window.size(); ++c) {
                const glm::dvec2 u = window[b] - window[a], v = window[c] - window[a];
                const double side = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
                height = std::min(height, std::abs(u.x * v.y - u.y * v.x) / side);
            }
        }
    }
    return longest / height;
}

template <class StepOf>
std::vector<SurfaceStep> steps_of(const Scene& scene, const Camera& camera, const Visibility& visible,
                                  std::span<const ReferenceSurface> surfaces, StepOf step_of) {
    const View view(camera, visible.width, visible.height);
    std::vector<SurfaceStep> steps(surfaces.size());
    for (size_t i = 0; i < steps.size(); ++i) {
        if (!surfaces[i].covered) continue;
        const auto width = static_cast<size_t>(visible.width);
        steps[i] = step_of(view, seen_triangle(scene, camera, visible.triangles[i]), surfaces[i],
                           view.ray(static_cast<int>(i % width), static_cast<int>(i / width)));
    }
    return steps;
}

template <class Move>
std::vector<ReferenceSurface> moved(std::span<const ReferenceSurface> surfaces, Move move) {
    std::vector<ReferenceSurface> result(surfaces.begin(), surfaces.end());
    for (size_t i = 0; i < result.size(); ++i) {
        if (result[i].covered) move(result[i], i);
    }
    return result;
}

void turn(glm::dvec3& normal, double angle, bool other_way) {
    const glm::dvec3 aside = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    glm::dvec3 along = glm::normalize(glm::cross(normal, aside));
    if (other_way) along = glm::cross(normal, along);
    normal = glm::normalize(normal + angle * along);
}

// The angle whose cosine is larger by kRoundings.
double narrowed(double degrees) {
    return glm::degrees(std::acos(std::min(std::cos(glm::radians(degrees)) + kRoundings, 1.0)));
}

std::vector<Light> with_less_reach(std::span<const Light> lights) {
    std::vector<Light> result(lights.begin(), lights.end());
    for (Light& light : result) light.radius *= 1.0 - kRoundings;
    return result;
}

std::vector<Light> with_shifted_cones(std::span<const Light> lights) {
    std::vector<Light> result(lights.begin(), lights.end());
    for (Light& light : result) {
        if (light.kind != LightKind::spot) continue;
        light.inner_deg = narrowed(light.inner_deg);
        light.outer_deg = narrowed(light.outer_deg);
    }
    return result;
}

}  // namespace

std::vector<SurfaceStep> shading_steps(std::span<const ReferenceSurface> surfaces) {
    std::vector<SurfaceStep> steps;
    for (const ReferenceSurface& s : surfaces) {
        steps.push_back({.position = kRoundings * glm::length(s.position), .normal = kRoundings});
    }
    return steps;
}

std::vector<SurfaceStep> interpolation_steps(const Scene& scene, const Camera& camera, const Visibility& visible,
                                             std::span<const ReferenceSurface> surfaces) {
    const double size = std::max(visible.width, visible.height);
    return steps_of(scene, camera, visible, surfaces,
                    [&](const View& view, const SeenTriangle& t, const ReferenceSurface& s, const glm::dvec3&) {
                        const auto corners = before_near_plane(t, view, camera.near_distance);
                        const double distance = view.distance(s.position), away = glm::length(s.position);
                        double nearest = distance, farthest = distance;
                        for (const glm::dvec3& corner : corners) {
                            nearest = std::min(nearest, view.distance(corner));
                            farthest = std::max(farthest, view.distance(corner));
                        }
                        const double amplified = window_amplification(corners, view, size) * distance / nearest;
                        // What does not change over the triangle is multiplied by one over the distance all the same.
                        const double slope = 1.0 - nearest / farthest;
                        return SurfaceStep{
                            .position = kRoundings * (away + amplified * (t.position_range + away * slope)),
                            .normal = kRoundings * (t.cancellation + amplified * (t.normal_range + slope))};
                    });
}

std::vector<SurfaceStep> rebuilding_steps(const Scene& scene, const Camera& camera, const Visibility& visible,
                                          std::span<const ReferenceSurface> surfaces) {
    return steps_of(
        scene, camera, visible, surfaces,
        [](const View&, const SeenTriangle& t, const ReferenceSurface& s, const glm::dvec3& ray) {
            const glm::dvec3 normal = glm::cross(t.edge1, t.edge2);
            const double corner = glm::length(t.corner), edge1 = glm::length(t.edge1), edge2 = glm::length(t.edge2);
            const double facing = std::abs(glm::dot(normal, ray)), distance = std::abs(glm::dot(normal, t.corner));
            const double of_place = glm::length(ray) * edge1 * edge2 / facing + edge1 * edge2 * corner / distance;
            const double of_weights = glm::length(ray) * (std::max(edge1, edge2) * corner + edge1 * edge2) / facing;
            return SurfaceStep{.position = kRoundings * glm::length(s.position) * (1.0 + of_place),
                               .normal = kRoundings * (t.cancellation + of_weights * t.normal_range)};
        });
}

std::vector<Light> lights_in_float(std::span<const Light> lights, const glm::dvec3& eye) {
    std::vector<Light> result(lights.begin(), lights.end());
    for (Light& light : result) {
        light.position = in_float(light.position - eye);
        light.direction = in_float(light.direction);
        light.color = in_float(light.color);
        light.radius = std::max(rounded_to_float(light.radius), kLeastRadius);
    }
    return result;
}

BoundedRadiance bounded_radiance(const Scene& scene, std::span<const ReferenceSurface> surfaces,
                                 std::span<const SurfaceStep> steps, int width, int height,
                                 std::span<const Light> lights) {
    Camera camera = scene.camera;
    camera.eye = glm::dvec3(0.0);
    const auto shade = [&](std::span<const ReferenceSurface> of, std::span<const Light> by) {
        return shade_reference(scene, of, width, height, camera, by);
    };
    BoundedRadiance result{.radiance = shade(surfaces, lights), .movement = std::vector<double>(surfaces.size())};
    const auto add = [&](const std::vector<glm::dvec3>& other) {
        for (size_t i = 0; i < other.size(); ++i) result.movement[i] += largest(other[i] - result.radiance[i]);
    };
    for (int axis = 0; axis < 3; ++axis) {
        add(shade(moved(surfaces, [&](ReferenceSurface& s, size_t i) { s.position[axis] += steps[i].position; }),
                  lights));
    }
    for (const bool other_way : {false, true}) {
        add(shade(moved(surfaces, [&](ReferenceSurface& s, size_t i) { turn(s.normal, steps[i].normal, other_way); }),
                  lights));
    }
    add(shade(surfaces, with_less_reach(lights)));
    add(shade(surfaces, with_shifted_cones(lights)));
    return result;
}

}  // namespace lightsweep
