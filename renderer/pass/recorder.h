// What a pass's `record` may do: pick a stage, draw. Everything is bound already.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/gl/query.h"
#include "renderer/gl/state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

/// A mesh around the unit sphere for light volumes, and an empty vertex array for full-screen triangles.
class DrawShapes {
  public:
    DrawShapes();
    void draw_full_screen() const;
    void bind_sphere() const;
    void draw_sphere() const;

  private:
    gl::VertexArray empty_, sphere_array_;
    gl::Buffer sphere_vertices_, sphere_indices_;
    uint32_t sphere_index_count_ = 0;
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
    Recorder(const DrawInput& input, std::span<const CompiledStage> stages) : input_(input), stages_(stages) {}
    /// From here on, counts the fragments that pass in draws of the last stage. Never while measuring.
    void count_samples() { counting_ = true; }
    /// Waits for the counts.
    uint64_t samples() const;

    const Frame& frame() const { return input_.frame; }
    void use_stage(size_t index);
    void draw_visible_meshes();
    void draw_full_screen();
    /// Before draw_light_volume, once.
    void bind_light_volume() { input_.shapes.bind_sphere(); }
    /// The sphere around one light, with the current stage's program.
    void draw_light_volume(uint32_t light);

  private:
    template <class Draw>
    void counted(Draw draw);

    const DrawInput& input_;
    std::span<const CompiledStage> stages_;
    size_t stage_ = 0;
    bool counting_ = false;
    std::vector<gl::SamplesQuery> queries_;
};

/// The usual `record`s.
void draw_visible_meshes(Recorder& recorder);
void draw_full_screen(Recorder& recorder);

}  // namespace lightsweep
