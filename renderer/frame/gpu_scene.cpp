#include "renderer/frame/gpu_scene.h"

#include "renderer/base/float_split.h"
#include "shaders/shared/slots.h"
#include "shaders/shared/types.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace lightsweep {
namespace {

constexpr gl::VertexBinding kVertexBinding{.binding = 0, .stride_bytes = sizeof(Vertex)};
constexpr gl::VertexBinding kVisibleBinding{.binding = 1, .stride_bytes = sizeof(uint32_t), .divisor = 1};

struct TextureKind {
    bool SceneNeeds::*needed;
    int Material::*texture;
    unsigned unit;
};
constexpr TextureKind kTextureKinds[] = {
    {&SceneNeeds::base_color_textures, &Material::base_color_texture, shared::kBaseColorUnit},
    {&SceneNeeds::metallic_roughness_textures, &Material::metallic_roughness_texture, shared::kMetallicRoughnessUnit},
    {&SceneNeeds::normal_textures, &Material::normal_texture, shared::kNormalUnit},
    {&SceneNeeds::emissive_textures, &Material::emissive_texture, shared::kEmissiveUnit},
};

shared::InstanceData instance_data(const glm::dmat4& m) {
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    const glm::vec3 high(m[3]);
    const glm::vec3 low(beyond_float(m[3].x), beyond_float(m[3].y), beyond_float(m[3].z));
    // The cofactor matrix is the inverse transpose times the determinant: it exists for singular matrices too. Its
    // scale is divided out, since cofactors of a scale of 1e-20 would underflow in float.
    const double sign = glm::dot(glm::cross(x, y), z) < 0.0 ? -1.0 : 1.0;
    glm::dvec3 nx = sign * glm::cross(y, z), ny = sign * glm::cross(z, x), nz = sign * glm::cross(x, y);
    double largest = 0.0;
    for (const auto& v : {nx, ny, nz}) largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest > 0.0) {
        nx /= largest;
        ny /= largest;
        nz /= largest;
    }
    return {glm::vec4(glm::vec3(x), high.x), glm::vec4(glm::vec3(y), high.y), glm::vec4(glm::vec3(z), high.z),
            glm::vec4(glm::vec3(nx), low.x), glm::vec4(glm::vec3(ny), low.y), glm::vec4(glm::vec3(nz), low.z)};
}

// What shaders/lib/visible_surface.glsl unpacks.
glm::uvec2 instance_mesh(const Batch& batch) {
    return {batch.first_index, batch.material << 1 | (batch.mirrored ? 1U : 0U)};
}

// Three texels.
static_assert(sizeof(Vertex) == 48 && offsetof(Vertex, normal) == 12 && offsetof(Vertex, tangent) == 24 &&
              offsetof(Vertex, uv) == 40);

template <class T>
gl::TexelBuffer texels(std::span<const T> items, const std::string& label, gl::Format format) {
    return {gl::Buffer(std::as_bytes(items), label), format};
}

gl::Texture white_texel() {
    gl::Texture texture({.filter = gl::Filter::trilinear, .label = "white"});
    const uint8_t texel[] = {255, 255, 255, 255};
    texture.upload_rgba8(texel);
    return texture;
}

}  // namespace

// The box's corners after the transform are center +- x +- y +- z: which of the eight is farthest depends on the angles
// between the axes, so that a sheared box needs more than its longest axis says.
//
// Shaders multiply and add in single precision (unit 2^-24): a product of two rounded numbers and two sums put a vertex
// off by up to 4 units of the sum of its products' magnitudes, taken here as 16.
InstanceBounds instance_bounds(const Bounds& mesh, const glm::dmat4& transform) {
    constexpr double kVertexRounding = 0x1p-20;
    if (mesh.empty()) return {glm::dvec3(transform[3]), 0.0};
    const glm::dvec3 half = 0.5 * mesh.size(), most = glm::max(glm::abs(mesh.low), glm::abs(mesh.high));
    const glm::dvec3 x(transform[0]), y(transform[1]), z(transform[2]);
    double radius = 0.0;
    for (const double sign_y : {-1.0, 1.0}) {
        for (const double sign_z : {-1.0, 1.0}) {
            radius = std::max(radius, glm::length(half.x * x + sign_y * half.y * y + sign_z * half.z * z));
        }
    }
    const double products = glm::length(x) * most.x + glm::length(y) * most.y + glm::length(z) * most.z;
    return {glm::dvec3(transform * glm::dvec4(mesh.center(), 1.0)), radius + kVertexRounding * products};
}

void SphereArrays::add(const InstanceBounds& sphere) {
    x.push_back(sphere.center.x);
    y.push_back(sphere.center.y);
    z.push_back(sphere.center.z);
    radius.push_back(static_cast<float>(sphere.radius));
}

GpuScene::GpuScene(const Scene& scene, const SceneNeeds& needs) : scene_(&scene), needs_(needs) {
    make_batches();
    upload_geometry();
    upload_materials();
}

void GpuScene::make_batches() {
    std::map<std::pair<uint32_t, bool>, size_t> batch_of;
    for (uint32_t i = 0; i < scene_->instances.size(); ++i) {
        const Instance& instance = scene_->instances[i];
        const Mesh& mesh = scene_->meshes[instance.mesh];
        const bool mirrored = glm::determinant(glm::dmat3(instance.transform)) < 0.0;
        const auto [found, is_new] = batch_of.try_emplace({instance.mesh, mirrored}, batches_.size());
        if (is_new) {
            batches_.push_back({.mesh = instance.mesh,
                                .first_index = mesh.first_index,
                                .index_count = mesh.index_count,
                                .material = mesh.material,
                                .double_sided = scene_->materials[mesh.material].double_sided,
                                .mirrored = mirrored,
                                .instances = {}});
        }
        batches_[found->second].instances.push_back(i);
        instance_bounds_.push_back(lightsweep::instance_bounds(mesh.bounds, instance.transform));
    }
    for (const Batch& batch : batches_) {
        for (const uint32_t i : batch.instances) batch_spheres_.add(instance_bounds_[i]);
    }
}

void GpuScene::upload_geometry() {
    std::vector<shared::InstanceData> instances;
    instances.reserve(scene_->instances.size());
    for (const auto& instance : scene_->instances) instances.push_back(instance_data(instance.transform));
    std::vector<glm::uvec2> instance_meshes(instances.size());
    for (const Batch& batch : batches_) {
        for (const uint32_t i : batch.instances) instance_meshes[i] = instance_mesh(batch);
    }
    vertices_ = texels<Vertex>(scene_->vertices, "vertices", gl::Format::RGBA32F);
    indices_ = texels<uint32_t>(scene_->indices, "indices", gl::Format::R32UI);
    instances_ = texels<shared::InstanceData>(instances, "instances", gl::Format::RGBA32F);
    instance_meshes_ = texels<glm::uvec2>(instance_meshes, "meshes of instances", gl::Format::RG32UI);

    const gl::VertexBinding bindings[] = {kVertexBinding, kVisibleBinding};
    const gl::VertexAttribute attributes[] = {
        {shared::kPositionAttribute, 0, 3, offsetof(Vertex, position)},
        {shared::kNormalAttribute, 0, 3, offsetof(Vertex, normal)},
        {shared::kTangentAttribute, 0, 4, offsetof(Vertex, tangent)},
        {shared::kTexcoordAttribute, 0, 2, offsetof(Vertex, uv)},
        {shared::kInstanceAttribute, 1, 1, 0, true},
    };
    vertex_array_ = gl::VertexArray(bindings, attributes, "meshes");
    vertex_array_.set_buffer(kVertexBinding, vertices_.buffer());
    vertex_array_.set_indices(indices_.buffer());
    memory_bytes_ =
        vertices_.size_bytes() + indices_.size_bytes() + instances_.size_bytes() + instance_meshes_.size_bytes();
}

void GpuScene::upload_materials() {
    for (size_t i = 0; i < scene_->materials.size(); ++i) {
        const Material& m = scene_->materials[i];
        const shared::MaterialData data{
            .base_color = m.base_color,
            .roughness = m.roughness,
            .specular = m.specular,
            .metallic = m.metallic,
            .emissive = m.emissive,
            .model = static_cast<uint32_t>(m.model),
            // No 8-bit texel is flat: 128 / 255 tilts the normal by a quarter of a degree. A scale of 0 is.
            .normal_scale = m.normal_texture == kNoTexture ? 0.0F : m.normal_scale,
            .alpha_cutoff = m.alpha_cutoff,
            .specular_from_luminance = m.specular_from_luminance ? 1.0F : 0.0F,
            .id = static_cast<uint32_t>(i),
            .double_sided = m.double_sided ? 1U : 0U,
            .unused_0 = 0,
            .unused_1 = 0,
            .unused_2 = 0,
        };
        materials_.emplace_back(std::as_bytes(std::span(&data, 1)), "material " + m.name);
        memory_bytes_ += materials_.back().size_bytes();
    }
    white_ = white_texel();
    if (!needs_.textures()) return;
    for (const auto& image : scene_->textures) {
        textures_.emplace_back(gl::TextureDesc{.width = image.width,
                                               .height = image.height,
                                               .format = image.srgb ? gl::Format::SRGB8_A8 : gl::Format::RGBA8,
                                               .filter = gl::Filter::trilinear,
                                               .label = image.name});
        textures_.back().upload_rgba8(image.rgba);
        memory_bytes_ += textures_.back().size_bytes();
    }
}

void GpuScene::bind(const gl::Buffer& visible_instances) const {
    vertex_array_.bind();
    vertex_array_.set_buffer(kVisibleBinding, visible_instances);
    instances_.bind(shared::kInstanceUnit);
}

void GpuScene::bind_geometry() const {
    instance_meshes_.bind(shared::kInstanceMeshUnit);
    vertices_.bind(shared::kVertexUnit);
    indices_.bind(shared::kIndexUnit);
}

void GpuScene::bind_material(uint32_t material) const {
    materials_[material].bind_uniform(shared::kMaterialBlock);
    if (!needs_.textures()) return;
    const Material& m = scene_->materials[material];
    for (const TextureKind& kind : kTextureKinds) {
        if (!(needs_.*kind.needed)) continue;
        const int texture = m.*kind.texture;
        (texture == kNoTexture ? white_ : textures_[static_cast<size_t>(texture)]).bind(kind.unit);
    }
}

void GpuScene::bind_unneeded_textures() const {
    for (const TextureKind& kind : kTextureKinds) {
        if (!(needs_.*kind.needed)) white_.bind(kind.unit);
    }
}

}  // namespace lightsweep
