// Lights by cell of a grid, built on the CPU. Pure functions: a frame in, lists out; no GL.
#pragma once

#include "renderer/frame/light_bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

/// What a path asks for.
struct LightGridDesc {
    int tile_px = 16;           ///< of clusters: in a picture of 720 lines; in others about the same part of it
    bool slices = false;        ///< cells are cut along the view distance too: clusters
    bool depth_bounds = false;  ///< cells end where the surfaces of their tile do; for tiles alone
};

/// The grid for one frame. Slices are about as deep as their tiles are wide and cover the distances that the lights
/// reach up to the far plane, so the grid depends on the lights.
shared::LightGridData make_light_grid(const LightGridDesc& desc, const FrameSetup& setup,
                                      std::span<const shared::LightBounds> lights);

inline size_t cell_count(const shared::LightGridData& grid) {
    return size_t{grid.tiles_x} * grid.tiles_y * grid.slices;
}

/// The view distances of the surfaces that a tile shows; low > high: none.
struct DepthRange {
    float low, high;
};

/// One cell's part of LightLists::indices.
struct CellList {
    uint32_t offset = 0, count = 0;
    bool operator==(const CellList&) const = default;
};

/// Neighbouring cells of one row, and a light that touches them.
struct CellRun {
    uint32_t begin, end;  ///< tile indices
    uint32_t light;       ///< index into Frame::lights
};

struct LightLists {
    std::vector<CellList> cells;    ///< by cell index
    std::vector<uint32_t> indices;  ///< indices into Frame::lights, rising within a cell

    /// What build_light_lists works on, one slice at a time; kept for its memory.
    struct Scratch {
        std::vector<uint32_t> slice_ends, slice_lights;
        std::vector<CellRun> runs;
        std::vector<uint32_t> places;
    } scratch;
};

/// 4 GiB of indices; offsets of 32 bits hold them all.
inline constexpr size_t kMostListIndices = size_t{1} << 30;

/// Throws EnvironmentError when there would be more than `max_indices`, before it takes the memory for them.
/// Each cell's lights are those whose bounds `light_touches_cell` (shaders/shared/light_cell.h). `tile_depths`: one for
/// each tile, row by row from the lower left, for a grid without slices; or empty. `first_light` is added to each
/// index. Reuses the memory of `lists`.
void build_light_lists(const shared::LightGridData& grid, std::span<const shared::LightBounds> lights,
                       std::span<const DepthRange> tile_depths, uint32_t first_light, LightLists& lists,
                       size_t max_indices = kMostListIndices);

}  // namespace lightsweep
