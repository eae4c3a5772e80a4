#include "renderer/scene/gltf.h"

#include "renderer/base/error.h"
#include "renderer/scene/geometry.h"
#include "renderer/scene/gltf_file.h"
#include "renderer/scene/gltf_material.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace lightsweep {
namespace {

// The transform a node has in its parent.
glm::dmat4 local_transform(const GltfFile& file, const tinygltf::Node& node, const std::string& pointer) {
    const auto check = [&](const std::vector<double>& numbers, size_t size, const char* key) {
        if (numbers.empty()) return false;
        if (numbers.size() != size) file.fail(pointer + "/" + key, fmt::format("{} numbers were expected", size));
        return true;
    };
    if (check(node.matrix, 16, "matrix")) return glm::make_mat4(node.matrix.data());
    glm::dmat4 transform(1.0);
    if (check(node.translation, 3, "translation")) {
        transform = glm::translate(transform, glm::make_vec3(node.translation.data()));
    }
    if (check(node.rotation, 4, "rotation")) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (!(length > 1e-6 && std::isfinite(length))) file.fail(pointer + "/rotation", "is not a unit quaternion");
        transform *= glm::mat4_cast(q / length);
    }
    if (check(node.scale, 3, "scale")) transform = glm::scale(transform, glm::make_vec3(node.scale.data()));
    return transform;
}

// The roots of the scene that is shown; without scenes, every node that is nobody's child.
std::vector<int> root_nodes(const GltfFile& file) {
    const auto& model = file.model;
    if (!model.scenes.empty()) {
        const int shown = std::max(model.defaultScene, 0);
        file.check_index(shown, model.scenes.size(), "scenes", "/scene");
        return model.scenes[static_cast<size_t>(shown)].nodes;
    }
    std::set<int> roots;
    for (size_t i = 0; i < model.nodes.size(); ++i) roots.insert(static_cast<int>(i));
    for (const auto& node : model.nodes) {
        for (const int child : node.children) roots.erase(child);
    }
    return {roots.begin(), roots.end()};
}

struct PlacedMesh {
    int mesh;
    glm::dmat4 transform;
};

// Every mesh that the scene shows, parents before children, in the file's order.
std::vector<PlacedMesh> placed_meshes(const GltfFile& file, std::vector<std::string>& warnings) {
    struct Visit {
        int node;
        glm::dmat4 parent;
    };
    const auto& nodes = file.model.nodes;
    std::vector<PlacedMesh> placed;
    std::vector<Visit> stack;
    const auto push = [&](const std::vector<int>& children, const glm::dmat4& parent, const std::string& pointer) {
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            file.check_index(*child, nodes.size(), "nodes", pointer);
            stack.push_back({*child, parent});
        }
    };
    push(root_nodes(file), glm::dmat4(1.0), "/scenes");
    std::set<int> visited;
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const std::string pointer = fmt::format("/nodes/{}", visit.node);
        if (!visited.insert(visit.node).second) file.fail(pointer, "stands in the scene more than once, or in a cycle");
        const auto& node = file.model.nodes[static_cast<size_t>(visit.node)];
        const glm::dmat4 transform = visit.parent * local_transform(file, node, pointer);
        if (node.mesh >= 0) {
            file.check_index(node.mesh, file.model.meshes.size(), "meshes", pointer + "/mesh");
            placed.push_back({node.mesh, transform});
        }
        if (node.skin >= 0) warn_once(warnings, file, "skins are ignored; the model stands as it was modelled");
        push(node.children, transform, pointer + "/children");
    }
    if (!file.model.animations.empty()) warn_once(warnings, file, "animations are ignored");
    return placed;
}

// Reads one triangle list; normals and tangents that are missing or unusable are generated.
Geometry read_primitive(const GltfFile& file, const tinygltf::Primitive& primitive, const std::string& pointer,
                        std::vector<std::string>& warnings) {
    // The values of an attribute, or none when the primitive has no such attribute.
    size_t vertex_count = 0;
    const auto attribute = [&](const char* name, int components) {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) return std::vector<float>();
        const std::string here = fmt::format("{}/attributes/{}", pointer, name);
        auto values = read_floats(file, found->second, components, here);
        const size_t count = values.size() / static_cast<size_t>(components);
        if (vertex_count == 0) vertex_count = count;
        if (count != vertex_count)
            file.fail(here, fmt::format("{} vertices were expected, not {}", vertex_count, count));
        return values;
    };
    const auto positions = attribute("POSITION", 3);
    if (positions.empty()) file.fail(pointer + "/attributes", "the key 'POSITION' is missing, or has no element");
    const auto normals = attribute("NORMAL", 3);
    const auto tangents = attribute("TANGENT", 4);
    const auto uvs = attribute("TEXCOORD_0", 2);
    if (primitive.attributes.contains("COLOR_0")) warn_once(warnings, file, "vertex colours are ignored");
    if (!primitive.targets.empty()) warn_once(warnings, file, "morph targets are ignored");

    Geometry geometry;
    geometry.vertices.resize(vertex_count);
    bool has_normals = !normals.empty();
    bool has_tangents = has_normals && !tangents.empty();
    for (size_t i = 0; i < vertex_count; ++i) {
        Vertex& v = geometry.vertices[i];
        v.position = glm::make_vec3(&positions[3 * i]);
        v.uv = uvs.empty() ? glm::vec2(0.0F) : glm::make_vec2(&uvs[2 * i]);
        if (has_normals) {
            const glm::dvec3 normal = glm::make_vec3(&normals[3 * i]);
            has_normals = glm::length(normal) > 1e-6;
            v.normal = glm::normalize(normal);
        }
        if (has_tangents) {
            const glm::dvec3 tangent = glm::make_vec3(&tangents[4 * i]);
            has_tangents = glm::length(glm::cross(tangent, glm::dvec3(v.normal))) > 1e-6;
            v.tangent = glm::vec4(glm::normalize(tangent), tangents[4 * i + 3] < 0.0F ? -1.0F : 1.0F);
        }
    }
    if (primitive.indices >= 0) {
        geometry.indices = read_indices(file, primitive.indices, vertex_count, pointer + "/indices");
    } else {
        geometry.indices.resize(vertex_count);
        std::iota(geometry.indices.begin(), geometry.indices.end(), 0U);
    }
    if (geometry.indices.size() % 3 != 0) {
        file.fail(pointer, fmt::format("{} indices do not make whole triangles", geometry.indices.size()));
    }
    if (!has_normals) {
        if (!normals.empty()) warn_once(warnings, file, "normals of length 0 were replaced by flat ones");
        make_flat_normals(geometry);
    }
    if (!has_normals || !has_tangents) make_tangents(geometry);
    return geometry;
}

}  // namespace

GltfModel append_gltf(const std::filesystem::path& path, Scene& scene) {
    const GltfFile file = open_gltf(path, scene.warnings);
    const auto placed = placed_meshes(file, scene.warnings);

    std::set<int> used_materials;
    for (const auto& [mesh, transform] : placed) {
        const auto& primitives = file.model.meshes[static_cast<size_t>(mesh)].primitives;
        for (size_t i = 0; i < primitives.size(); ++i) {
            const int material = primitives[i].material;
            if (material != kDefaultGltfMaterial) {
                file.check_index(material, file.model.materials.size(), "materials",
                                 fmt::format("/meshes/{}/primitives/{}/material", mesh, i));
            }
            used_materials.insert(material);
        }
    }
    const auto materials = append_gltf_materials(file, used_materials, scene);

    GltfModel result;
    std::map<int, std::vector<uint32_t>> scene_meshes;  // of each glTF mesh
    for (const auto& [mesh, transform] : placed) {
        const auto [found, is_new] = scene_meshes.try_emplace(mesh);
        const auto& source = file.model.meshes[static_cast<size_t>(mesh)];
        for (size_t i = 0; is_new && i < source.primitives.size(); ++i) {
            const auto& primitive = source.primitives[i];
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
                warn_once(scene.warnings, file, "points, lines, strips and fans are not drawn");
                continue;
            }
            const std::string pointer = fmt::format("/meshes/{}/primitives/{}", mesh, i);
            const Geometry geometry = read_primitive(file, primitive, pointer, scene.warnings);
            if (geometry.indices.empty()) continue;
            found->second.push_back(static_cast<uint32_t>(scene.meshes.size()));
            scene.meshes.push_back(append_geometry(scene, geometry, source.name, path.string()));
            scene.meshes.back().material = materials.at(primitive.material);
        }
        for (const uint32_t scene_mesh : found->second) {
            const Bounds bounds = transformed(scene.meshes[scene_mesh].bounds, transform);
            const glm::dvec3 size = bounds.size();
            if (!std::isfinite(size.x + size.y + size.z)) file.fail("/nodes", "the transforms grow past any bounds");
            result.bounds.include(bounds.low);
            result.bounds.include(bounds.high);
            result.parts.push_back({scene_mesh, transform});
        }
    }
    if (result.parts.empty()) throw InputError(file.path, "shows no triangles");
    return result;
}

}  // namespace lightsweep
