// Instances hidden behind others, left out in two phases (Haar and Aaltonen 2015, "GPU-Driven Rendering Pipelines",
// SIGGRAPH Advances in Real-Time Rendering): what could be seen in the last frame is drawn first; the depth that it
// leaves says which of the others cannot be seen now; the rest is drawn after it. So nothing pops, wherever the camera
// was before: what is left out lies behind surfaces of this very frame.
//
// Where nothing was hidden, the next frames draw all and do not look: one, then two, and so on up to kMostRests (as
// Mattausch, Bittner and Wimmer 2008, "CHC++", space their queries). Only time depends on it, never the picture.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

/// The farthest view distance that each square of the picture shows, halved in size again and again (Greene, Kass and
/// Miller 1993, "Hierarchical Z-buffer visibility"). A square without a surface, or partly, is infinitely far.
class DepthPyramid {
  public:
    /// `farthest`: one for each tile, row by row from the lower left.
    void build(std::span<const float> farthest, int tiles_x, int tiles_y);
    /// The farthest of all tiles in [x0, x1) x [y0, y1), or of a few more: one look at the level where they are at most
    /// 2 x 2. The range must not be empty, nor leave the picture.
    float farthest(int x0, int y0, int x1, int y1) const;

  private:
    struct Level {
        int width = 0, height = 0;
        std::vector<float> texels;
        /// Of the texels in two columns and two rows, which may be the same.
        float farthest(int x0, int y0, int x1, int y1) const;
    };
    std::vector<Level> levels_;
};

/// For each sphere (view space: x right, y up, z the view distance; with its radius), whether it lies behind all that
/// its rectangle on the screen shows. Never true for one that a pixel may show, nor for one that touches the near side.
/// `setup`: whose picture it is. `hidden`: as many as spheres.
void find_hidden_spheres(std::span<const glm::vec4> spheres, const FrameSetup& setup, const DepthPyramid& pyramid,
                         int tile_px, std::span<uint8_t> hidden);

class OcclusionCuller {
  public:
    static constexpr int kTilePx = 16;
    static constexpr int kMostRests = 16;

    /// Before the frame is drawn: splits its visible instances into those seen in the frame before, and others. Keeps
    /// a reference to both until the next call. In the first frame, and in the first of another scene, all count as
    /// seen.
    void begin(const GpuScene& scene, const Frame& frame);

    /// After those seen before were drawn. `tile_depths`: RG32F, a texel for each tile of kTilePx; y: the farthest view
    /// distance that it shows, infinite (1e30) where a pixel of it shows none. Waits for it and reads it back.
    void find_hidden(const gl::Texture& tile_depths);

    /// Whether this frame draws all and need not be asked what it hides.
    bool rests() const { return rests_; }

    /// Of this frame, in its order. In one that does not rest, newly_seen and visible are empty until find_hidden is
    /// done; then `visible` is both others together.
    const DrawList& draws(Instances which) const;

    /// Of the frame's visible instances, those that are in none of the lists.
    uint64_t hidden_instances() const { return hidden_instances_; }
    uint64_t hidden_triangles() const { return hidden_triangles_; }
    /// How many draws more the frame had without hiding; below 0 where batches are drawn in both phases.
    int64_t saved_draws() const { return saved_draws_; }

  private:
    const GpuScene* scene_ = nullptr;
    const Frame* frame_ = nullptr;
    std::vector<uint8_t> seen_;  ///< by instance of the scene: in the last frame
    DrawList seen_before_, newly_seen_, visible_;
    DepthPyramid pyramid_;
    std::vector<glm::vec4> spheres_;
    std::vector<uint8_t> hidden_;
    bool rests_ = false;
    int rests_left_ = 0;
    int next_rests_ = 1;  ///< as many, where nothing is hidden again
    int64_t saved_draws_ = 0;
    uint64_t hidden_instances_ = 0;
    uint64_t hidden_triangles_ = 0;
};

}  // namespace lightsweep
