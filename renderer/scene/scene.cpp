#include "renderer/scene/scene.h"

#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/base/resources.h"
#include "renderer/scene/geometry.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/scene_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace lightsweep {
namespace {

// A running hash over plain values; each is chained on the hash of those before.
class Digest {
  public:
    template <typename... T>
    void add(const T&... values) {
        (add_bytes(&values, sizeof values), ...);
        static_assert((std::is_trivially_copyable_v<T> && ...));
    }

    template <typename T>
    void add_array(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(values.size());
        add_bytes(values.data(), values.size() * sizeof(T));
    }

    std::string hex() const { return fmt::format("{:016x}", hash_); }

  private:
    void add_bytes(const void* data, size_t size) { hash_ = hash_bytes({static_cast<const char*>(data), size}, hash_); }

    uint64_t hash_ = 0;
};

// Field by field: structs have padding. Names and warnings are left out, as they change no pixel.
std::string hash_content(const Scene& scene) {
    static_assert(sizeof(Vertex) == 12 * sizeof(float), "vertices are hashed as bytes and must have no padding");
    Digest digest;
    digest.add_array(scene.vertices);
    digest.add_array(scene.indices);
    for (const auto& m : scene.meshes) digest.add(m.first_index, m.index_count, m.material);
    for (const auto& m : scene.materials) {
        digest.add(m.model, m.base_color, m.roughness, m.metallic, m.specular, m.specular_from_luminance, m.emissive,
                   m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.emissive_texture,
                   m.normal_scale, m.alpha_cutoff, m.double_sided);
    }
    for (const auto& t : scene.textures) {
        digest.add(t.width, t.height, t.srgb);
        digest.add_array(t.rgba);
    }
    for (const auto& i : scene.instances) digest.add(i.mesh, i.transform);
    const auto& c = scene.camera;
    digest.add(c.eye, c.target, c.up, c.fov_y_deg, c.near_distance, c.far_distance);
    for (const auto& l : scene.lights.fixed) {
        digest.add(l.kind, l.position, l.direction, l.color, l.radius, l.inner_deg, l.outer_deg);
    }
    if (const auto& g = scene.lights.generator) {
        digest.add(g->placement, g->bounds.low, g->bounds.high, g->height_min, g->height_max, g->seed, g->radius,
                   g->intensity, g->saturation, g->spot_share, g->inner_deg, g->outer_deg);
    }
    digest.add(scene.lights.default_count, scene.lights.default_overlap, scene.ambient, scene.background);
    return digest.hex();
}

// The nearest camera along `direction` (unit, from the model) whose square field of view holds all of `bounds`.
Camera camera_around(const Bounds& bounds, const glm::dvec3& direction) {
    Camera camera{.target = bounds.center(), .fov_y_deg = 45.0};
    const glm::dvec3 right = glm::normalize(glm::cross(camera.up, direction));
    const glm::dvec3 up = glm::cross(direction, right);
    const glm::dvec3 half = 0.5 * bounds.size();
    double distance = 0.0;
    double toward = 0.0;  // of the corner nearest to the camera; the farthest is its opposite
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = half * glm::dvec3((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                                               (corner & 4) != 0 ? 1.0 : -1.0);
        const double across = std::max(std::abs(glm::dot(p, right)), std::abs(glm::dot(p, up)));
        toward = std::max(toward, glm::dot(p, direction));
        distance = std::max(distance, across / std::tan(glm::radians(0.5 * camera.fov_y_deg)) + glm::dot(p, direction));
    }
    distance = 1.05 * distance + 1e-6;  // a margin, also for a model that is a point
    camera.eye = camera.target + distance * direction;
    camera.near_distance = 0.9 * (distance - toward);
    camera.far_distance = 1.1 * (distance + toward);
    return camera;
}

// A model alone: a camera in front of it and a little above, and lights all around it.
Scene scene_of_gltf(const std::filesystem::path& file) {
    Scene scene;
    scene.summary = "the model " + file.filename().string();
    const GltfModel model = append_gltf(file, scene);
    scene.instances = model.parts;
    scene.camera = camera_around(model.bounds, glm::normalize(glm::dvec3(0.45, 0.3, 1.0)));

    const double radius = std::max(0.5 * glm::length(model.bounds.size()), 1e-6);
    LightGenerator generator{.placement = Placement::random, .bounds = model.bounds, .radius = radius};
    generator.bounds.low -= 0.25 * radius;
    generator.bounds.high += 0.25 * radius;
    generator.intensity = 1.25 * radius * radius;  // 8 lights that reach a mid-grey surface light it well
    scene.lights = {.fixed = {}, .generator = generator, .default_count = 16, .default_overlap = 8.0};
    scene.ambient = glm::dvec3(0.1);
    scene.background = glm::dvec3(0.02);
    return scene;
}

}  // namespace

const std::vector<std::string> kShadingModelNames{"ggx", "blinn_phong", "lambert"};

uint64_t Scene::triangle_count() const {
    uint64_t count = 0;
    for (const auto& instance : instances) count += meshes[instance.mesh].index_count / 3;
    return count;
}

Bounds Scene::world_bounds() const {
    Bounds bounds;
    for (const auto& instance : instances) {
        const Bounds box = transformed(meshes[instance.mesh].bounds, instance.transform);
        if (box.empty()) continue;
        bounds.include(box.low);
        bounds.include(box.high);
    }
    return bounds;
}

Scene load_scene(const std::string& key_or_path) {
    const std::vector<std::string> extensions{".json", ".gltf", ".glb"};
    const auto file = find_resource("scene", key_or_path, "scenes", extensions);
    if (std::find(extensions.begin(), extensions.end(), file.extension()) == extensions.end()) {
        throw InputError(file.string(), "is no scene; .json, .gltf and .glb files are");
    }
    Scene scene = file.extension() == ".json" ? read_scene_json(file) : scene_of_gltf(file);
    scene.key = file.stem().string();
    scene.content_hash = hash_content(scene);
    return scene;
}

}  // namespace lightsweep
