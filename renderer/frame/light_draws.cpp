#include "renderer/frame/light_draws.h"

namespace lightsweep {
namespace {

struct ViewSphere {
    glm::vec3 center;  // view space: x right, y up, z the view distance
    float radius;
    uint32_t instance;
};

// Camera-relative world to view space, from the frame's rays: they stand at right angles.
glm::dmat3 view_from_world(const shared::FrameData& data) {
    return glm::transpose(glm::dmat3(glm::normalize(glm::dvec3(data.ray_right)),
                                     glm::normalize(glm::dvec3(data.ray_up)),
                                     glm::normalize(glm::dvec3(data.ray_forward))));
}

bool touch(const ViewSphere& sphere, const shared::LightBounds& light) {
    const glm::vec3 apart = sphere.center - light.center;
    const float reach = sphere.radius + light.radius;
    return glm::dot(apart, apart) <= reach * reach;
}

}  // namespace

LightDraws make_light_draws(const GpuScene& scene, const Frame& frame, const DrawList& drawn,
                            std::span<const shared::LightBounds> lights) {
    const glm::dmat3 to_view = view_from_world(frame.data);
    const glm::dvec3 eye = frame.setup.camera.eye;
    LightDraws result;
    std::vector<ViewSphere> spheres;
    for (const DrawCall& visible : drawn.draws) {
        spheres.clear();
        for (uint32_t i = 0; i < visible.instance_count; ++i) {
            const uint32_t instance = drawn.instances[visible.first_visible + i];
            const InstanceBounds& bounds = scene.instance_bounds()[instance];
            const glm::dvec3 center = to_view * (bounds.center - eye);
            // A little more, for rounding.
            const double radius = bounds.radius + 1e-6 * (bounds.radius + glm::length(center));
            spheres.push_back({glm::vec3(center), static_cast<float>(radius), instance});
        }
        for (uint32_t i = 0; i < lights.size(); ++i) {
            const auto first = static_cast<uint32_t>(result.instances.size());
            for (const ViewSphere& sphere : spheres) {
                if (touch(sphere, lights[i])) result.instances.push_back(sphere.instance);
            }
            const auto count = static_cast<uint32_t>(result.instances.size()) - first;
            if (count == 0) continue;
            result.draws.push_back({frame.data.directional_count + i, {visible.batch, count, first}});
        }
    }
    return result;
}

}  // namespace lightsweep
