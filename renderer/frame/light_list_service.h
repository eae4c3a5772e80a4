// The one service that lists lights for the cells of a grid, on the CPU or in a compute shader, for forward and
// deferred paths alike. Both builders make the same lists.
#pragma once

#include "renderer/frame/light_lists.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texel_buffer.h"
#include "renderer/gl/texture.h"

#include <string>
#include <vector>

namespace lightsweep {

enum class ListBuilder : uint8_t { cpu, compute };
/// By value: "cpu", "compute".
const std::vector<std::string>& list_builder_names();

class LightListService {
  public:
    /// `position_error`: see light_bounds.
    LightListService(const LightGridDesc& desc, ListBuilder builder, double position_error);

    /// The lists of a frame that is uploaded and bound (FrameBuffers). `tile_depths`: RG32F, a texel for each tile with
    /// the lowest and highest view distance of its surfaces, when the grid has depth bounds; the CPU waits for it and
    /// reads it back. Throws EnvironmentError when the device cannot hold the lists, naming the limit.
    void build(const Frame& frame, const gl::Texture* tile_depths);

    /// For shaders with lib/light_list.glsl.
    void bind() const;

    /// A compute shader's lists may need more room than there was; those that did not fit came out empty. Waits for the
    /// GPU, makes room, and says whether the frame must be drawn again. The CPU's lists always fit. Throws as `build`,
    /// also when the device ended loops of the builder or would end those that walk the lists.
    bool grow_if_cut_short();

    /// The lists as built last. Waits; never while measuring.
    LightLists read() const;
    const shared::LightGridData& grid() const { return grid_; }
    size_t memory_bytes() const;

  private:
    // As lists/light_list.comp.glsl writes it.
    struct Wanted {
        uint64_t indices;  // two words, lower first
        uint32_t lists_cut, unused;
    };

    void build_on_cpu(const gl::Texture* tile_depths);
    void build_on_gpu(const gl::Texture* tile_depths);
    Wanted read_wanted() const;
    void check_lengths(std::span<const CellList> cells) const;

    LightGridDesc desc_;
    ListBuilder builder_;
    double position_error_;
    shared::LightGridData grid_{};
    uint32_t directional_count_ = 0;
    std::vector<shared::LightBounds> bounds_;
    LightLists lists_;  ///< of the CPU's builder
    gl::Buffer grid_block_;
    gl::TexelBuffer cells_, indices_;
    // Of the compute builder: bounds, one bit per light and tile, what came of it.
    gl::TexelBuffer bounds_texels_, masks_;
    gl::Buffer wanted_;
    gl::Program mask_program_, list_program_;
};

}  // namespace lightsweep
