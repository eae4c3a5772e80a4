// What a pass's `record` may do: pick a stage, draw. Everything is bound already.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/frame/light_list_service.h"
#include "renderer/frame/occlusion.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/program.h"
#include "renderer/gl/query.h"
#include "renderer/gl/state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

/// Meshes for light volumes (renderer/pass/volume_meshes.h), and an empty vertex array for full-screen triangles.
class DrawShapes {
  public:
    DrawShapes();
    void bind_full_screen() const;
    void draw_full_screen() const;
    void bind_volumes() const;
    void draw_sphere() const { gl::draw_indexed(sphere_); }
    void draw_cone() const { gl::draw_indexed(cone_); }

  private:
    gl::VertexArray empty_, volumes_;
    gl::Buffer volume_vertices_, volume_indices_;
    gl::IndexedDraw sphere_, cone_;
};

/// What `execute` draws: a frame of a scene, uploaded.
struct DrawInput {
    const GpuScene& scene;
    const Frame& frame;
    const FrameBuffers& buffers;
    const DrawShapes& shapes;
};

struct CompiledStage {
    gl::Program program;
    gl::RasterState state;
};

class Recorder {
  public:
    /// `position_error`: of the layout; see light_bounds.
    Recorder(const DrawInput& input, std::span<const CompiledStage> stages, double position_error)
        : input_(input), stages_(stages), position_error_(position_error) {}
    /// From here on, counts the fragments that pass in draws of the last stage. Never while measuring.
    void count_samples() { counting_ = true; }
    /// The instances of this pass, and where they are on the GPU.
    void set_drawn(const DrawList& drawn, const gl::Buffer& instances) {
        drawn_ = &drawn;
        drawn_instances_ = &instances;
    }
    /// The same for instances that are still to be written there, when they are drawn.
    void set_drawn_unwritten(const DrawList& drawn, gl::Buffer& instances) {
        set_drawn(drawn, instances);
        unwritten_instances_ = &instances;
    }
    /// Without, the rasteriser lets back faces through, and shaders with KEEPS_BACK_FACES see to them.
    void set_back_face_culling(bool on) { culls_back_faces_ = on; }
    /// What find_hidden asks; may be null.
    void set_occlusion(OcclusionCuller* culler, const gl::Texture* occluder_depth) {
        occlusion_ = culler;
        occluder_depth_ = occluder_depth;
    }
    /// What build_light_lists builds, and from which depth ranges; may be null.
    void set_light_lists(LightListService* lists, const gl::Texture* tile_depth) {
        light_lists_ = lists;
        tile_depth_ = tile_depth;
    }
    /// Waits for the counts.
    uint64_t samples() const;

    const Frame& frame() const { return input_.frame; }
    const GpuScene& scene() const { return input_.scene; }
    /// What draw_visible_meshes draws.
    const DrawList& drawn() const { return *drawn_; }
    /// What the frame's point and spot lights reach, in their order.
    std::vector<shared::LightBounds> light_bounds() const;

    void use_stage(size_t index);
    void draw_visible_meshes();
    /// The same, with a number of each mesh's material as the stencil's reference: for states that store it.
    void draw_visible_meshes_marking_materials();
    void draw_full_screen();
    /// One full-screen draw for each material of the frame, the stencil's reference as above. Two materials may have
    /// the same number: the shader tells them apart. Binds the scene's vertices, indices and meshes as texels.
    void draw_full_screen_per_material();
    void build_light_lists();
    void find_hidden();
    /// For states with a scissor test.
    void set_scissor(const PixelRect& rect);

    // For each of many lights (the shader's `light_index`); what the draws share is bound once, first.
    void bind_full_screen() { input_.shapes.bind_full_screen(); }
    void draw_light_screen(uint32_t light);
    void bind_light_volumes() { input_.shapes.bind_volumes(); }
    /// The sphere around a point light, the cone around a spot.
    void draw_light_volume(uint32_t light);
    /// What `first_visible` of the following draws counts in.
    void bind_instances(std::span<const uint32_t> instances);
    void bind_batch(uint32_t batch);
    /// Instances of the batch that is bound.
    void draw_light_instances(uint32_t light, const DrawCall& draw);

  private:
    template <class Draw>
    void counted(Draw draw);
    void set_light(uint32_t light);
    void bind_drawn();
    void draw_batch(const DrawCall& draw);

    const DrawInput& input_;
    const DrawList* drawn_ = nullptr;
    const gl::Buffer* drawn_instances_ = nullptr;
    gl::Buffer* unwritten_instances_ = nullptr;
    bool culls_back_faces_ = true;
    OcclusionCuller* occlusion_ = nullptr;
    const gl::Texture* occluder_depth_ = nullptr;
    LightListService* light_lists_ = nullptr;
    const gl::Texture* tile_depth_ = nullptr;
    std::span<const CompiledStage> stages_;
    double position_error_;
    gl::Buffer instances_;  // of bind_instances
    size_t stage_ = 0;
    bool counting_ = false;
    static constexpr size_t kMostQueries = 1024;
    std::vector<gl::SamplesQuery> queries_;
    uint64_t counted_ = 0;  // by queries that are gone
};

/// The usual `record`s.
void draw_visible_meshes(Recorder& recorder);
void draw_full_screen(Recorder& recorder);
void build_lists(Recorder& recorder);
void find_hidden_instances(Recorder& recorder);

}  // namespace lightsweep
