// Views, lights and points at random, and what reaches them, in double precision and apart from the code under test.
#pragma once

#include "renderer/base/random.h"
#include "renderer/frame/light_lists.h"
#include "shaders/shared/light_cell.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lightsweep {

inline double log_uniform(Random& random, double low, double high) {
    return low * std::pow(high / low, random.uniform());
}

inline glm::dvec3 random_direction(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 6.283185307179586);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

inline FrameSetup plain_setup(int width = 320, int height = 180) {
    return {.camera = {.eye = {3.0, 2.0, 1.0}, .target = {-4.0, 1.0, 7.0}}, .width = width, .height = height};
}

/// A camera anywhere, of any angle and range; a small picture of odd size.
inline FrameSetup random_setup(Random& random) {
    FrameSetup setup;
    setup.camera.eye = 100.0 * random_direction(random);
    setup.camera.target = setup.camera.eye + random_direction(random);
    setup.camera.fov_y_deg = random.index(4) == 0 ? log_uniform(random, 0.1, 170.0) : random.uniform(30.0, 90.0);
    setup.camera.near_distance = log_uniform(random, 1e-3, 1.0);
    setup.camera.far_distance = setup.camera.near_distance * log_uniform(random, 10.0, 1e9);
    setup.width = static_cast<int>(log_uniform(random, 1.0, 400.0));
    setup.height = static_cast<int>(log_uniform(random, 1.0, 250.0));
    return setup;
}

/// A camera's axes and picture: points in view space are (right, up, forward).
struct TestView {
    explicit TestView(const FrameSetup& s) : setup(s) {
        forward = glm::normalize(s.camera.target - s.camera.eye);
        right = glm::normalize(glm::cross(forward, s.camera.up));
        up = glm::cross(right, forward);
        tan_y = std::tan(s.camera.fov_y_deg * 3.141592653589793 / 360.0);
        tan_x = tan_y * s.width / s.height;
    }
    glm::dvec3 to_world(const glm::dvec3& v) const { return v.x * right + v.y * up + v.z * forward; }
    /// The point at view distance 1 under a pixel's centre.
    glm::dvec3 ray(int x, int y) const {
        return {((x + 0.5) / setup.width * 2.0 - 1.0) * tan_x, ((y + 0.5) / setup.height * 2.0 - 1.0) * tan_y, 1.0};
    }
    FrameSetup setup;
    glm::dvec3 right, up, forward;
    double tan_x, tan_y;
};

/// Around and in the view, the eye inside some, others behind; a third of them spots.
inline Light random_light(const TestView& view, Random& random) {
    const Camera& camera = view.setup.camera;
    const double far = std::min(camera.far_distance, camera.near_distance * 1e5);
    const double z = log_uniform(random, camera.near_distance, far);
    glm::dvec3 place(random.uniform(-1.3, 1.3) * view.tan_x * z, random.uniform(-1.3, 1.3) * view.tan_y * z, z);
    if (random.index(8) == 0) place = random_direction(random) * z;
    Light light{.position = camera.eye + view.to_world(place), .direction = random_direction(random)};
    light.radius = glm::length(place) * log_uniform(random, 1e-3, 3.0);
    if (random.index(3) == 0) {
        light.kind = LightKind::spot;
        light.outer_deg = random.index(2) == 0 ? log_uniform(random, 0.5, 120.0) : random.uniform(10.0, 80.0);
        light.inner_deg = light.outer_deg * random.uniform(0.0, 0.99);
    }
    return light;
}

inline std::vector<Light> random_lights(const TestView& view, int count, Random& random) {
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) lights.push_back(random_light(view, random));
    return lights;
}

inline Frame frame_of(const FrameSetup& setup, const std::vector<Light>& lights) {
    Frame frame;
    frame.setup = setup;
    set_camera_constants(setup, frame.data);
    collect_lights(lights, frame);
    return frame;
}

/// Whether a light of a frame shines on a point, which is relative to the eye, along world axes.
inline bool reaches(const shared::LightData& light, const glm::dvec3& point) {
    const glm::dvec3 to_point = point - glm::dvec3(light.position);
    const double distance = glm::length(to_point);
    if (distance >= light.radius) return false;
    const double cosine = distance > 0.0 ? glm::dot(to_point / distance, glm::dvec3(light.direction)) : 1.0;
    return cosine * light.spot_scale + light.spot_offset > 0.0;
}

/// A surface in the picture: at `place` in view space, under the centre of pixel (x, y); shading reads it at `read`.
struct SurfacePoint {
    int x, y;
    glm::dvec3 place, read;
};

/// Somewhere that a light of the frame may just reach, or anywhere. `read` is off by up to `error` of the distance.
inline SurfacePoint random_point(const TestView& view, const Frame& frame, double error, Random& random) {
    const FrameSetup& setup = view.setup;
    const double near = setup.camera.near_distance, far = setup.camera.far_distance;
    SurfacePoint point{static_cast<int>(random.index(static_cast<uint64_t>(setup.width))),
                       static_cast<int>(random.index(static_cast<uint64_t>(setup.height))),
                       {},
                       {}};
    double z = log_uniform(random, near, far);
    if (!frame.lights.empty() && random.index(10) != 0) {
        const auto& light = frame.lights[random.index(frame.lights.size())];
        const glm::dvec3 aim = light.spot_scale == 0.0F || random.index(2) == 0
                                   ? random_direction(random)
                                   : glm::dvec3(light.direction) + 0.5 * random_direction(random);
        const double share = random.index(2) == 0 ? std::cbrt(random.uniform()) : random.uniform(0.97, 1.0);
        const double from = share * light.radius;
        const glm::dvec3 at = glm::dvec3(light.position) + from * glm::normalize(aim);
        const glm::dvec3 seen(glm::dot(at, view.right), glm::dot(at, view.up), glm::dot(at, view.forward));
        if (seen.z > 0.0) {
            z = std::clamp(seen.z, near, far);
            const auto pixel = [](double slope, double tangent, int size) {
                return static_cast<int>(std::clamp((slope / tangent + 1.0) * 0.5 * size, 0.0, size - 1.0));
            };
            point.x = pixel(seen.x / seen.z, view.tan_x, setup.width);
            point.y = pixel(seen.y / seen.z, view.tan_y, setup.height);
        }
    }
    point.place = z * view.ray(point.x, point.y);
    point.read = point.place + error * random.uniform() * glm::length(point.place) * random_direction(random);
    return point;
}

/// The index of the cell that a shader looks a point up in.
inline size_t cell_of(const shared::LightGridData& grid, const SurfacePoint& point) {
    const uint32_t slice = shared::slice_of(grid, static_cast<float>(point.read.z));
    const auto px = static_cast<int>(grid.tile_px);
    return (size_t{slice} * grid.tiles_y + static_cast<uint32_t>(point.y / px)) * grid.tiles_x +
           static_cast<uint32_t>(point.x / px);
}

inline std::span<const uint32_t> lights_of_cell(const LightLists& lists, size_t cell) {
    return std::span(lists.indices).subspan(lists.cells[cell].offset, lists.cells[cell].count);
}

}  // namespace lightsweep
