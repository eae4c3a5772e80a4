#include "renderer/frame/frame.h"

#include "renderer/base/float_split.h"
#include "renderer/frame/cull.h"
#include "renderer/frame/light_bounds.h"
#include "shaders/shared/slots.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace lightsweep {
namespace {

// Positions that a G-buffer stores in half floats are off by up to 2^-10 of their distance; lights that reach them
// there count, too.
constexpr float kLightMargin = 0x1p-9F;

// What shaders divide by is its square, and that is a number above zero. A light without a radius reaches no surface
// with the least one, and one without an end every surface with the most.
constexpr double kLeastRadius = 1e-18, kMostRadius = 1e18;

// Shaders divide an intensity by 1e-4 at least. What becomes infinite there, times a lobe of zero, would be no number.
constexpr double kMostIntensity = 3e34;

void set_depth_constants(const Camera& camera, DepthConvention convention, shared::FrameData& data) {
    const double n = camera.near_distance, f = camera.far_distance;
    // depth = A + B / z, so z = B / (depth - A); see camera_projection. A = depth_clear - depth_offset.
    const bool reversed = convention == DepthConvention::reversed;
    const double sign = reversed ? 1.0 : -1.0;
    data.depth_scale = static_cast<float>(sign * n * f / (f - n));
    data.depth_offset = static_cast<float>(sign * n / (f - n));
    data.depth_clear = reversed ? 0.0F : 1.0F;
}

// What a spot's two angles say. Most spots of a scene have the same ones.
struct SpotCone {
    double inner_deg = -1.0, outer_deg = -1.0;
    double cos_outer = 0.0;
    // (dot(axis, -l) * scale + offset), clamped and squared: 1 inside the inner cone, 0 outside the outer one (glTF
    // KHR_lights_punctual).
    float scale = 0.0F, offset = 0.0F;

    void follow(const Light& light) {
        if (light.inner_deg == inner_deg && light.outer_deg == outer_deg) return;
        inner_deg = light.inner_deg;
        outer_deg = light.outer_deg;
        cos_outer = std::cos(glm::radians(outer_deg));
        const double exact_scale = 1.0 / std::max(std::cos(glm::radians(inner_deg)) - cos_outer, 1e-4);
        scale = static_cast<float>(exact_scale);
        offset = static_cast<float>(-cos_outer * exact_scale);
    }
};

shared::LightData light_data(const Light& light, const glm::dvec3& relative) {
    return {.position = glm::vec3(relative),
            .radius = static_cast<float>(std::clamp(light.radius, kLeastRadius, kMostRadius)),
            .color = glm::vec3(glm::clamp(light.color, -kMostIntensity, kMostIntensity)),
            .spot_scale = 0.0F,
            .direction = glm::vec3(light.direction),
            .spot_offset = 1.0F};
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// A light that stands, points or ends nowhere reaches no surface, and no bounds could be found for it. An infinite
// radius is a radius.
bool has_place(const Light& light) {
    const bool points_somewhere = is_finite(light.direction);
    if (light.kind == LightKind::directional) return points_somewhere;
    return is_finite(light.position) && !std::isnan(light.radius) &&
           (light.kind == LightKind::point || points_somewhere);
}

bool gives_nothing(const Light& light) { return light.radius <= 0.0 || light.color == glm::dvec3(0.0); }

// Points and spots on their way into a frame: as many as ViewVolume tests at once.
class LocalLights {
  public:
    explicit LocalLights(Frame& frame) : frame_(frame), view_(frame.setup, kLightMargin) {}

    void add(const Light& light) {
        const glm::dvec3 relative = light.position - frame_.setup.camera.eye;
        Sphere sphere{relative, light.radius};
        if (light.kind == LightKind::spot) {
            cone_.follow(light);
            sphere = sphere_around_cone(relative, light.direction, light.radius, cone_.cos_outer);
        }
        lights_[count_] = &light;
        spheres_.x[count_] = static_cast<float>(sphere.center.x);
        spheres_.y[count_] = static_cast<float>(sphere.center.y);
        spheres_.z[count_] = static_cast<float>(sphere.center.z);
        spheres_.radius[count_] = static_cast<float>(sphere.radius);
        if (++count_ == SphereChunk::kCapacity) finish();
    }

    /// Moves those that can reach the view into the frame.
    void finish() {
        view_.test(spheres_, count_);
        for (size_t i = 0; i < count_; ++i) {
            if (culls_ && spheres_.inside[i] == 0) continue;
            const Light& light = *lights_[i];
            frame_.lights.push_back(light_data(light, light.position - frame_.setup.camera.eye));
            if (light.kind == LightKind::point) continue;
            cone_.follow(light);
            frame_.lights.back().spot_scale = cone_.scale;
            frame_.lights.back().spot_offset = cone_.offset;
        }
        count_ = 0;
    }

  private:
    Frame& frame_;
    ViewVolume view_;
    const bool culls_ = frame_.setup.skips.has(Skip::light_frustum);
    SphereChunk spheres_;
    std::array<const Light*, SphereChunk::kCapacity> lights_;
    SpotCone cone_;
    size_t count_ = 0;
};

}  // namespace

void DrawList::clear() {
    draws.clear();
    instances.clear();
}

CameraBasis camera_basis(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {right, glm::cross(right, forward), forward};
}

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
    data.camera_low = glm::vec3(beyond_float(camera.eye.x), beyond_float(camera.eye.y), beyond_float(camera.eye.z));
    data.ray_right = glm::vec3(basis.right * tan_x);
    data.ray_up = glm::vec3(basis.up * tan_y);
    data.ray_forward = glm::vec3(basis.forward);
    data.pixel_to_ndc_x = static_cast<float>(2.0 / setup.width);
    data.pixel_to_ndc_y = static_cast<float>(2.0 / setup.height);
    set_depth_constants(camera, setup.convention, data);
}

float view_distance(const shared::FrameData& data, float depth) {
    return data.depth_scale / ((depth - data.depth_clear) + data.depth_offset);
}

void collect_lights(const std::vector<Light>& lights, Frame& frame) {
    const bool culls = frame.setup.skips.has(Skip::light_frustum);
    frame.lights.clear();
    frame.lights.reserve(lights.size());
    LocalLights local(frame);
    std::vector<shared::LightData> directional;
    for (const Light& light : lights) {
        if (!has_place(light)) continue;
        if (light.kind != LightKind::directional) {
            if (!culls || !gives_nothing(light)) local.add(light);
        } else if (!culls || light.color != glm::dvec3(0.0)) {
            directional.push_back(light_data(light, light.position - frame.setup.camera.eye));
        }
    }
    local.finish();
    frame.lights.insert(frame.lights.begin(), directional.begin(), directional.end());
    frame.data.directional_count = static_cast<uint32_t>(directional.size());
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
    cull_instances(scene.batches(), scene.batch_spheres(), frame);
    collect_lights(lights, frame);
}

// Sizes that most scenes fit in; the buffers grow when one does not.
FrameBuffers::FrameBuffers()
    : constants_(sizeof(shared::FrameData), "frame constants"),
      visible_instances_(1024 * sizeof(uint32_t), "visible instances"),
      lights_(gl::Buffer(1024 * sizeof(shared::LightData), "lights"), gl::Format::RGBA32F) {}

void FrameBuffers::upload(const Frame& frame) {
    constants_.write(std::as_bytes(std::span(&frame.data, 1)));
    visible_instances_.write_items<uint32_t>(frame.visible.instances);
    lights_.write_items<shared::LightData>(frame.lights);
}

void FrameBuffers::bind(const GpuScene& scene) const {
    constants_.bind_uniform(shared::kFrameBlock);
    lights_.bind(shared::kLightUnit);
    scene.bind(visible_instances_);
}

}  // namespace lightsweep
