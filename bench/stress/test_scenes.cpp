#include "bench/stress/test_scenes.h"

#include <glm/ext/matrix_transform.hpp>

namespace lightsweep {

void add_instance(Scene& scene, const Geometry& geometry, const Material& material, const glm::dmat4& transform) {
    Mesh mesh = append_geometry(scene, geometry, "mesh", "a stress scene");
    mesh.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    scene.meshes.push_back(mesh);
    add_instance(scene, static_cast<uint32_t>(scene.meshes.size()) - 1, transform);
}

void add_instance(Scene& scene, uint32_t mesh, const glm::dmat4& transform) {
    scene.instances.push_back({.mesh = mesh, .transform = transform});
}

Scene facing_plane(const Material& material, double size, double distance) {
    Scene scene;
    scene.key = "plane";
    add_instance(scene, make_shape(QuadShape{.size = glm::dvec2(size)}), material);
    scene.camera = {.eye = {0.0, 0.0, distance},
                    .target = glm::dvec3(0.0),
                    .near_distance = 0.01 * distance,
                    .far_distance = 100.0 * distance};
    return scene;
}

Scene sphere_scene(const Material& material) {
    Scene scene;
    scene.key = "sphere";
    add_instance(scene, make_shape(SphereShape{.radius = 1.0, .segments = 128, .rings = 64}), material);
    scene.camera = {.eye = {0.0, 0.0, 3.0}, .target = glm::dvec3(0.0)};
    return scene;
}

Light point_light(const glm::dvec3& position, double radius, const glm::dvec3& color) {
    return {.kind = LightKind::point, .position = position, .color = color, .radius = radius};
}

Light spot_light(const glm::dvec3& position, const glm::dvec3& direction, double radius, double outer_deg,
                 const glm::dvec3& color) {
    return {.kind = LightKind::spot,
            .position = position,
            .direction = glm::normalize(direction),
            .color = color,
            .radius = radius,
            .inner_deg = 0.5 * outer_deg,
            .outer_deg = outer_deg};
}

Light sun(const glm::dvec3& direction, const glm::dvec3& color) {
    return {.kind = LightKind::directional, .direction = glm::normalize(direction), .color = color};
}

void declare_light_kinds(Scene& scene, bool points, bool spots, bool directional) {
    if (points) scene.lights.fixed.push_back(point_light(glm::dvec3(0.0), 1.0, glm::dvec3(0.0)));
    if (spots) {
        scene.lights.fixed.push_back(spot_light(glm::dvec3(0.0), {0.0, -1.0, 0.0}, 1.0, 30.0, glm::dvec3(0.0)));
    }
    if (directional) scene.lights.fixed.push_back(sun({0.0, -1.0, 0.0}, glm::dvec3(0.0)));
}

}  // namespace lightsweep
