#include "renderer/frame/frame.h"

#include "renderer/frame/light_bounds.h"
#include "shaders/shared/slots.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace lightsweep {
namespace {

struct CameraBasis {
    glm::dvec3 right, up, forward;
};

CameraBasis camera_basis(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {right, glm::cross(right, forward), forward};
}

// Planes with inward normals n: a camera-relative point p is inside when dot(n, p) + w >= 0 for all six.
struct Frustum {
    std::array<glm::dvec4, 6> planes;
    bool touches(const glm::dvec3& center, double radius) const {
        return std::all_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
            return glm::dot(glm::dvec3(plane), center) + plane.w >= -radius;
        });
    }
};

Frustum make_frustum(const FrameSetup& setup) {
    const Camera& camera = setup.camera;
    const CameraBasis basis = camera_basis(camera);
    const double tan_y = std::tan(glm::radians(camera.fov_y_deg) / 2.0);
    const double tan_x = tan_y * setup.width / setup.height;
    const auto side = [&](const glm::dvec3& across, double tangent) {
        return glm::dvec4(glm::normalize(basis.forward * tangent + across), 0.0);
    };
    return {{side(basis.right, tan_x), side(-basis.right, tan_x), side(basis.up, tan_y), side(-basis.up, tan_y),
             glm::dvec4(basis.forward, -camera.near_distance), glm::dvec4(-basis.forward, camera.far_distance)}};
}

void set_depth_constants(const Camera& camera, DepthConvention convention, shared::FrameData& data) {
    const double n = camera.near_distance, f = camera.far_distance;
    // depth = A + B / z, so z = B / (depth - A); see camera_projection.
    const bool reversed = convention == DepthConvention::reversed;
    data.depth_scale = static_cast<float>((reversed ? 1.0 : -1.0) * n * f / (f - n));
    data.depth_offset = static_cast<float>(reversed ? n / (f - n) : -f / (f - n));
    data.depth_clear = reversed ? 0.0F : 1.0F;
}

void cull_instances(const GpuScene& scene, const Camera& camera, const Frustum& frustum, Frame& frame) {
    frame.draws.clear();
    frame.visible_instances.clear();
    const auto& bounds = scene.instance_bounds();
    for (uint32_t b = 0; b < scene.batches().size(); ++b) {
        const Batch& batch = scene.batches()[b];
        const auto first = static_cast<uint32_t>(frame.visible_instances.size());
        for (const uint32_t i : batch.instances) {
            if (frustum.touches(bounds[i].center - camera.eye, bounds[i].radius)) frame.visible_instances.push_back(i);
        }
        const auto count = static_cast<uint32_t>(frame.visible_instances.size()) - first;
        frame.work.instances_drawn += count;
        frame.work.instances_culled += batch.instances.size() - count;
        if (count == 0) continue;
        frame.work.triangles += uint64_t{count} * batch.index_count / 3;
        frame.draws.push_back({b, count, first});
    }
    frame.work.draws = frame.draws.size();
}

// (dot(axis, -l) * scale + offset), clamped and squared: 1 inside the inner cone, 0 outside the outer one (glTF
// KHR_lights_punctual).
void set_spot(const Light& light, double cos_outer, shared::LightData& data) {
    const double scale = 1.0 / std::max(std::cos(glm::radians(light.inner_deg)) - cos_outer, 1e-4);
    data.spot_scale = static_cast<float>(scale);
    data.spot_offset = static_cast<float>(-cos_outer * scale);
}

shared::LightData light_data(const Light& light, const glm::dvec3& relative) {
    return {.position = glm::vec3(relative),
            .radius = static_cast<float>(light.radius),
            .color = glm::vec3(light.color),
            .spot_scale = 0.0F,
            .direction = glm::vec3(light.direction),
            .spot_offset = 1.0F};
}

// A point or a spot, when what it reaches touches the view.
void collect_local_light(const Light& light, const Camera& camera, const Frustum& frustum, Frame& frame) {
    const glm::dvec3 relative = light.position - camera.eye;
    if (light.radius <= 0.0 || light.color == glm::dvec3(0.0) || !frustum.touches(relative, light.radius)) return;
    if (light.kind == LightKind::point) {
        frame.lights.push_back(light_data(light, relative));
        return;
    }
    const double cos_outer = std::cos(glm::radians(light.outer_deg));
    const Sphere sphere = sphere_around_cone(relative, light.direction, light.radius, cos_outer);
    if (!frustum.touches(sphere.center, sphere.radius)) return;
    set_spot(light, cos_outer, frame.lights.emplace_back(light_data(light, relative)));
}

}  // namespace

glm::dmat4 camera_projection(const Camera& camera, int width, int height, DepthConvention convention) {
    const CameraBasis basis = camera_basis(camera);
    const double tan_y = std::tan(glm::radians(camera.fov_y_deg) / 2.0);
    const double tan_x = tan_y * width / height;
    const double n = camera.near_distance, f = camera.far_distance;
    const bool reversed = convention == DepthConvention::reversed;
    // clip.w is the view distance z; clip.z = A z + B puts depth = A + B / z in [0, 1].
    const double a = reversed ? -n / (f - n) : f / (f - n);
    const double b = (reversed ? 1.0 : -1.0) * n * f / (f - n);
    const glm::dvec4 rows[] = {glm::dvec4(basis.right / tan_x, 0.0), glm::dvec4(basis.up / tan_y, 0.0),
                               glm::dvec4(basis.forward * a, b), glm::dvec4(basis.forward, 0.0)};
    return glm::transpose(glm::dmat4(rows[0], rows[1], rows[2], rows[3]));
}

void set_camera_constants(const FrameSetup& setup, shared::FrameData& data) {
    const Camera& camera = setup.camera;
    const CameraBasis basis = camera_basis(camera);
    const double tan_y = std::tan(glm::radians(camera.fov_y_deg) / 2.0);
    const double tan_x = tan_y * setup.width / setup.height;
    data.clip_from_world = glm::mat4(camera_projection(camera, setup.width, setup.height, setup.convention));
    data.camera_high = glm::vec3(camera.eye);
    data.camera_low = glm::vec3(camera.eye - glm::dvec3(data.camera_high));
    data.ray_right = glm::vec3(basis.right * tan_x);
    data.ray_up = glm::vec3(basis.up * tan_y);
    data.ray_forward = glm::vec3(basis.forward);
    data.pixel_to_ndc_x = static_cast<float>(2.0 / setup.width);
    data.pixel_to_ndc_y = static_cast<float>(2.0 / setup.height);
    set_depth_constants(camera, setup.convention, data);
}

void collect_lights(const std::vector<Light>& lights, Frame& frame) {
    const Camera& camera = frame.setup.camera;
    const Frustum frustum = make_frustum(frame.setup);
    frame.lights.clear();
    for (const Light& light : lights) {
        if (light.kind != LightKind::directional || light.color == glm::dvec3(0.0)) continue;
        frame.lights.push_back(light_data(light, light.position - camera.eye));
    }
    frame.data.directional_count = static_cast<uint32_t>(frame.lights.size());
    for (const Light& light : lights) {
        if (light.kind != LightKind::directional) collect_local_light(light, camera, frustum, frame);
    }
    frame.data.light_count = static_cast<uint32_t>(frame.lights.size());
    frame.work.lights_drawn = frame.lights.size();
    frame.work.lights_culled = lights.size() - frame.lights.size();
}

void build_frame(const GpuScene& scene, const std::vector<Light>& lights, const FrameSetup& setup, Frame& frame) {
    frame.setup = setup;
    frame.work = {};
    set_camera_constants(setup, frame.data);
    frame.data.ambient = glm::vec3(scene.scene().ambient);
    frame.data.background = glm::vec3(scene.scene().background);
    cull_instances(scene, setup.camera, make_frustum(setup), frame);
    collect_lights(lights, frame);
}

// Sizes that most scenes fit in; the buffers grow when one does not.
FrameBuffers::FrameBuffers()
    : constants_(sizeof(shared::FrameData), "frame constants"),
      visible_instances_(1024 * sizeof(uint32_t), "visible instances"),
      lights_(gl::Buffer(1024 * sizeof(shared::LightData), "lights"), gl::Format::RGBA32F) {}

void FrameBuffers::upload(const Frame& frame) {
    constants_.write(std::as_bytes(std::span(&frame.data, 1)));
    visible_instances_.write_items<uint32_t>(frame.visible_instances);
    lights_.write_items<shared::LightData>(frame.lights);
}

void FrameBuffers::bind(const GpuScene& scene) const {
    constants_.bind_uniform(shared::kFrameBlock);
    lights_.bind(shared::kLightUnit);
    scene.bind(visible_instances_);
}

}  // namespace lightsweep
