// "instances" of a scene file: shapes and glTF files, placed once or in grids.
#include "renderer/base/hash.h"
#include "renderer/base/names.h"
#include "renderer/base/random.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/scene_json.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <array>

namespace lightsweep {
namespace {

constexpr int64_t kMostInstances = 1'000'000;

// A material parameter that runs from one value to another along an axis of the grid.
struct Variation {
    int axis = 0;
    double from = 0.0, to = 1.0;
    bool given = false;
};

struct Grid {
    glm::ivec3 count{1};
    glm::dvec3 spacing{0.0};
    glm::dvec3 origin{0.0};  // of the first copy
    std::optional<uint64_t> turn_seed;
    Variation roughness, metallic;
};

Variation read_variation(const JsonReader& json, std::string_view key) {
    const auto member = json.find(key);
    if (!member) return {};
    member->allow_keys({"axis", "from", "to"});
    static const std::vector<std::string> axes{"x", "y", "z"};
    return {.axis = static_cast<int>(member->at("axis").choice("axis", axes)),
            .from = member->at("from").number(0.0, 1.0),
            .to = member->at("to").number(0.0, 1.0),
            .given = true};
}

Grid read_grid(const JsonReader& json) {
    json.allow_keys({"count", "spacing", "origin", "turn_seed", "vary"});
    Grid grid;
    const auto counts = json.at("count").elements();
    if (counts.size() != 3) json.at("count").fail(fmt::format("3 whole numbers were expected, not {}", counts.size()));
    int64_t copies = 1;
    for (int k = 0; k < 3; ++k) {
        const int64_t count = counts[static_cast<size_t>(k)].integer(1, kMostInstances);
        grid.count[k] = static_cast<int>(count);
        copies *= count;
        if (copies > kMostInstances) json.at("count").fail(fmt::format("more than {} copies", kMostInstances));
    }
    grid.spacing = read_vec3(json.at("spacing"), -kLargestLength, kLargestLength);
    const glm::dvec3 centered = -0.5 * grid.spacing * glm::dvec3(grid.count - 1);
    grid.origin = read_vec3_or(json, "origin", centered, -kLargestLength, kLargestLength);
    if (const auto seed = json.find("turn_seed")) grid.turn_seed = static_cast<uint64_t>(seed->integer(0, INT64_MAX));
    if (const auto vary = json.find("vary")) {
        vary->allow_keys({"roughness", "metallic"});
        grid.roughness = read_variation(*vary, "roughness");
        grid.metallic = read_variation(*vary, "metallic");
    }
    return grid;
}

// How each copy of an instance stands in its cell of the grid.
struct Pose {
    glm::dvec3 translate{0.0};
    glm::dmat4 rotate{1.0};
    glm::dvec3 scale{1.0};
};

Pose read_pose(const JsonReader& json) {
    Pose pose;
    pose.translate = read_vec3_or(json, "translate", pose.translate, -kLargestLength, kLargestLength);
    const glm::dvec3 angles = glm::radians(read_vec3_or(json, "rotate_deg", glm::dvec3(0.0), -360.0, 360.0));
    for (const int axis : {2, 1, 0}) {  // about x first, then y, then z
        glm::dvec3 about(0.0);
        about[axis] = 1.0;
        pose.rotate = glm::rotate(pose.rotate, angles[axis], about);
    }
    if (const auto scale = json.find("scale")) {
        pose.scale = scale->value().is_array() ? read_vec3(*scale, -1e6, 1e6) : glm::dvec3(scale->number(-1e6, 1e6));
        if (glm::any(glm::lessThan(glm::abs(pose.scale), glm::dvec3(1e-9)))) scale->fail("0 would flatten it");
    }
    return pose;
}

class InstanceReader {
  public:
    InstanceReader(const std::map<std::string, Material>& materials, const std::map<std::string, Geometry>& shapes,
                   Scene& scene)
        : materials_(materials), shapes_(shapes), scene_(scene) {}

    void read(const JsonReader& json) {
        const bool is_gltf = json.has("gltf");
        if (is_gltf) {
            json.allow_keys({"gltf", "translate", "rotate_deg", "scale", "fit_height", "grid"});
        } else {
            json.allow_keys({"shape", "material", "translate", "rotate_deg", "scale", "fit_height", "grid"});
        }
        const Pose pose = read_pose(json);
        const auto member = json.find("grid");
        const Grid grid = member ? read_grid(*member) : Grid{};
        copies_ += int64_t{grid.count.x} * grid.count.y * grid.count.z;
        if (copies_ > kMostInstances) json.fail(fmt::format("the scene has more than {} instances", kMostInstances));
        if (is_gltf) {
            read_gltf(json, pose, grid);
        } else {
            read_shape(json, pose, grid);
        }
    }

  private:
    void read_gltf(const JsonReader& json, const Pose& pose, const Grid& grid) {
        if (grid.roughness.given || grid.metallic.given) {
            json.at("grid").at("vary").fail("materials of a glTF file cannot be varied");
        }
        const GltfModel& model = gltf(json.at("gltf"));
        const glm::dmat4 fit = fit_transform(json, model.bounds);
        place(grid, pose, [&](const glm::ivec3&, const glm::dmat4& transform) {
            for (const Instance& part : model.parts) {
                scene_.instances.push_back({part.mesh, transform * fit * part.transform});
            }
        });
    }

    void read_shape(const JsonReader& json, const Pose& pose, const Grid& grid) {
        const std::string& shape = named(json.at("shape"), "shape", shapes_);
        const Material& material = materials_.at(named(json.at("material"), "material", materials_));
        if ((grid.roughness.given && material.model == ShadingModel::lambert) ||
            (grid.metallic.given && material.model != ShadingModel::ggx)) {
            json.at("grid").at("vary").fail(fmt::format("the material '{}' has no such parameter", material.name));
        }
        const Mesh& mesh = shape_mesh(shape, json.where());
        const glm::dmat4 fit = fit_transform(json, mesh.bounds);
        place(grid, pose, [&](const glm::ivec3& at, const glm::dmat4& transform) {
            const uint32_t index = mesh_index(shape, mesh, material_index(varied(material, grid, at)));
            scene_.instances.push_back({index, transform * fit});
        });
    }

    // The key of `all` that `json` names.
    template <typename T>
    static const std::string& named(const JsonReader& json, std::string_view what,
                                    const std::map<std::string, T>& all) {
        std::vector<std::string> names;
        for (const auto& [name, ignored] : all) names.push_back(name);
        return all.find(names.at(json.choice(what, names)))->first;
    }

    // The glTF file that `json` names, read once.
    const GltfModel& gltf(const JsonReader& json) {
        const auto path = json.file().parent_path() / json.string();
        std::error_code failed;
        const auto file = std::filesystem::canonical(path, failed);
        if (failed) json.fail(fmt::format("there is no file {}", path.string()));
        const auto [found, is_new] = models_.try_emplace(file.string());
        if (is_new) found->second = append_gltf(path, scene_);
        return found->second;
    }

    // "fit_height" makes it that tall and stands it on y = 0, centred.
    static glm::dmat4 fit_transform(const JsonReader& json, const Bounds& bounds) {
        const auto height = json.find("fit_height");
        if (!height) return glm::dmat4(1.0);
        if (json.has("scale")) height->fail("'scale' stands beside it; use one of them");
        if (bounds.size().y <= 0.0) height->fail("it is flat and cannot be fitted to a height");
        const glm::dvec3 base(bounds.center().x, bounds.low.y, bounds.center().z);
        const double scale = height->number(1e-6, kLargestLength) / bounds.size().y;
        return glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(scale)), -base);
    }

    // Calls add(cell, transform) for every copy: x fastest, z slowest.
    static void place(const Grid& grid, const Pose& pose, const auto& add) {
        uint64_t copy = 0;
        for (int z = 0; z < grid.count.z; ++z) {
            for (int y = 0; y < grid.count.y; ++y) {
                for (int x = 0; x < grid.count.x; ++x, ++copy) {
                    const glm::ivec3 at(x, y, z);
                    const glm::dvec3 position = pose.translate + grid.origin + grid.spacing * glm::dvec3(at);
                    glm::dmat4 transform = glm::translate(glm::dmat4(1.0), position) * pose.rotate;
                    if (grid.turn_seed) {
                        const std::array<uint64_t, 2> words{*grid.turn_seed, copy};
                        Random random(hash_bytes({reinterpret_cast<const char*>(words.data()), sizeof words}));
                        transform = glm::rotate(transform, glm::radians(random.uniform(0.0, 360.0)), {0.0, 1.0, 0.0});
                    }
                    add(at, glm::scale(transform, pose.scale));
                }
            }
        }
    }

    static Material varied(Material material, const Grid& grid, const glm::ivec3& at) {
        const auto vary = [&](const Variation& variation, float& value) {
            if (!variation.given) return;
            const int last = std::max(grid.count[variation.axis] - 1, 1);
            const double share = static_cast<double>(at[variation.axis]) / last;
            value = static_cast<float>(variation.from + (variation.to - variation.from) * share);
        };
        vary(grid.roughness, material.roughness);
        vary(grid.metallic, material.metallic);
        return material;
    }

    uint32_t material_index(const Material& material) {
        const auto [found, is_new] = material_indices_.try_emplace(
            {material.name, material.roughness, material.metallic}, static_cast<uint32_t>(scene_.materials.size()));
        if (is_new) scene_.materials.push_back(material);
        return found->second;
    }

    // The shape's geometry is appended once; each material that it is drawn with makes a mesh of the same triangles.
    const Mesh& shape_mesh(const std::string& name, const std::string& place) {
        const auto [found, is_new] = shape_meshes_.try_emplace(name);
        if (is_new) found->second = append_geometry(scene_, shapes_.at(name), name, place);
        return found->second;
    }

    uint32_t mesh_index(const std::string& shape_name, Mesh mesh, uint32_t material) {
        const auto [found, is_new] =
            mesh_indices_.try_emplace({shape_name, material}, static_cast<uint32_t>(scene_.meshes.size()));
        if (is_new) {
            mesh.material = material;
            scene_.meshes.push_back(std::move(mesh));
        }
        return found->second;
    }

    const std::map<std::string, Material>& materials_;
    const std::map<std::string, Geometry>& shapes_;
    Scene& scene_;
    int64_t copies_ = 0;  // of all instances so far
    std::map<std::string, GltfModel> models_;
    std::map<std::string, Mesh> shape_meshes_;
    std::map<std::tuple<std::string, float, float>, uint32_t> material_indices_;
    std::map<std::pair<std::string, uint32_t>, uint32_t> mesh_indices_;
};

}  // namespace

void read_instances(const JsonReader& json, const std::map<std::string, Material>& materials,
                    const std::map<std::string, Geometry>& shapes, Scene& scene) {
    InstanceReader reader(materials, shapes, scene);
    for (const auto& instance : json.elements()) reader.read(instance);
    if (scene.instances.empty()) json.fail("at least one instance was expected");
}

}  // namespace lightsweep
