// A scene on the GPU: vertices, instances, materials, textures. Uploaded once, shared by every path.
#pragma once

#include "renderer/frame/needs.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/texel_buffer.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/scene.h"

#include <vector>

namespace lightsweep {

/// A run of instances that one draw call covers: the same mesh, the same winding.
struct Batch {
    uint32_t mesh = 0;
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    uint32_t material = 0;
    bool double_sided = false;
    bool mirrored = false;            ///< the transform turns triangles inside out
    std::vector<uint32_t> instances;  ///< in scene order
};

/// A bounding sphere in world space: around all of an instance's vertices, wherever single precision puts them.
struct InstanceBounds {
    glm::dvec3 center;
    double radius;
};
InstanceBounds instance_bounds(const Bounds& mesh, const glm::dmat4& transform);

/// Bounding spheres, an array for each coordinate: for vector code.
struct SphereArrays {
    std::vector<double> x, y, z;
    std::vector<float> radius;

    void add(const InstanceBounds& sphere);
    size_t size() const { return x.size(); }
};

class GpuScene {
  public:
    /// Keeps a reference to `scene`, which must live longer.
    GpuScene(const Scene& scene, const SceneNeeds& needs);

    const Scene& scene() const { return *scene_; }
    const SceneNeeds& needs() const { return needs_; }
    const std::vector<Batch>& batches() const { return batches_; }
    const std::vector<InstanceBounds>& instance_bounds() const { return instance_bounds_; }
    /// The same, those of the first batch's instances first, then those of the next.
    const SphereArrays& batch_spheres() const { return batch_spheres_; }
    size_t memory_bytes() const { return memory_bytes_; }

    /// Binds vertices and the instances, whose visible ones `visible_instances` lists (uint32 each).
    void bind(const gl::Buffer& visible_instances) const;
    /// Binds vertices, indices and what each instance draws as texels, for shaders/lib/visible_surface.glsl.
    void bind_geometry() const;
    /// Binds the material's constants and textures.
    void bind_material(uint32_t material) const;
    /// Binds white to the units of the kinds of texture that the scene does not need: for shaders that sample them all
    /// (SceneNeeds::with_all_code).
    void bind_unneeded_textures() const;

  private:
    void make_batches();
    void upload_geometry();
    void upload_materials();

    const Scene* scene_;
    SceneNeeds needs_;
    std::vector<Batch> batches_;
    std::vector<InstanceBounds> instance_bounds_;
    SphereArrays batch_spheres_;
    gl::VertexArray vertex_array_;
    gl::TexelBuffer vertices_, indices_, instances_, instance_meshes_;
    std::vector<gl::Buffer> materials_;
    std::vector<gl::Texture> textures_;
    gl::Texture white_;
    size_t memory_bytes_ = 0;
};

}  // namespace lightsweep
