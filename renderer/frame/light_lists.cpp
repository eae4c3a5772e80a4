// A light touches a run of columns in each row of each slice that its sphere is cut into. So a list is made of runs:
// what light_touches_cell computes for a slice is computed once for the slice here, what it computes for a row once for
// the row, in the same arithmetic. Discs are gathered in arrays, which compilers make vector code of.
#include "renderer/frame/light_lists.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "shaders/shared/light_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace lightsweep {
namespace {

using shared::CellBounds;
using shared::LightBounds;
using shared::LightGridData;

// A slice's depth over its tiles' width at the centre of the view. Of the atrium at 1280x720, tiles of 32 px, 1,024
// lights: 1/2, 1, 2, 3 list 11.6, 12.3, 13.8, 15.4 lights for a surface (9.6 reach it) in lists of 1.2, 0.75, 0.42,
// 0.31 million indices.
constexpr double kElongation = 1.0;

// The first slice begins at the eye and ends at this part of the farthest distance reached, or further out.
constexpr double kFirstSliceEnd = 1.0 / 32.0;

constexpr uint32_t kLeastClusterTilePx = 8, kMostClusterTilePx = 64;
constexpr uint32_t kMaxSlices = 128;
constexpr uint32_t kMaxCells = 1U << 17;

// Each slice is deeper than the one before by this factor at least, or by what log2 and exp2 round they would overlap.
constexpr double kLeastGrowth = 1.0 + 0x1p-8;

// A surface is before the far plane, but the position that shading reads may be beyond it, by less than this factor:
// see light_bounds, which allows for an eighth of the distance.
constexpr double kBeyondFar = 2.0;

// With depth bounds, cells that are looked at beyond those that the slopes of the whole tile say, in tiles: those of a
// part of it may round outwards.
constexpr float kTileMargin = 1.0F / 16.0F;

struct DepthExtent {
    double low, high;
};

DepthExtent depth_extent(std::span<const LightBounds> lights) {
    DepthExtent extent{std::numeric_limits<double>::infinity(), 0.0};
    for (const LightBounds& light : lights) {
        extent.low = std::min(extent.low, double{light.center.z} - light.radius);
        extent.high = std::max(extent.high, double{light.center.z} + light.radius);
    }
    return extent;
}

uint32_t tiles_along(int pixels, uint32_t tile_px) { return (static_cast<uint32_t>(pixels) + tile_px - 1) / tile_px; }

// Clusters are the same part of a picture at every size, or a small picture would list far too much: of the atrium at
// 320x180, 16,384 lights, tiles of 32 px list 17 lights for each that reaches a surface, tiles of 8 px 2.7.
uint32_t cluster_tile_px(int tile_px_at_720, int height) {
    const auto scaled = static_cast<uint32_t>(static_cast<int64_t>(tile_px_at_720) * height / 720);
    return std::clamp(std::bit_floor(scaled), kLeastClusterTilePx, kMostClusterTilePx);
}

// The slopes and distances between cells, as cell_bounds and slice_begin give them.
struct Edges {
    std::vector<float> x, y, z;
    explicit Edges(const LightGridData& grid) : x(grid.tiles_x + 1), y(grid.tiles_y + 1), z(grid.slices + 1) {
        for (uint32_t i = 0; i <= grid.tiles_x; ++i) x[i] = shared::cell_bounds(grid, i, 0, 0.0F, 0.0F).slopes.x;
        for (uint32_t i = 0; i <= grid.tiles_y; ++i) y[i] = shared::cell_bounds(grid, 0, i, 0.0F, 0.0F).slopes.y;
        for (uint32_t i = 0; i <= grid.slices; ++i) z[i] = shared::slice_begin(grid, i);
    }
};

struct Range {
    uint32_t begin, end;
};

// The slices that overlap [low, high]. What slice_of says is at most one off.
Range slices_between(const LightGridData& grid, const std::vector<float>& edges, float low, float high) {
    if (high < 0.0F || low > edges[grid.slices]) return {0, 0};
    uint32_t begin = shared::slice_of(grid, low), end = shared::slice_of(grid, high) + 1;
    if (begin > 0 && edges[begin] >= low) --begin;
    if (edges[begin + 1] < low) ++begin;
    if (edges[end - 1] > high) --end;
    if (end < grid.slices && edges[end] <= high) ++end;
    return {begin, end};
}

// The rows or columns that overlap the slopes [low, high]; `per_slope` of them fit into a slope of 1. What
// multiplication says is at most one off. What is no number is everywhere: comparisons with it are false.
Range tiles_between(const std::vector<float>& edges, float per_slope, float low, float high) {
    const auto last = static_cast<int>(edges.size()) - 2;
    const auto most = static_cast<float>(last);
    const auto begin = static_cast<int>(std::min(std::max(0.0F, (low - edges[0]) * per_slope), most));
    const auto end = static_cast<int>(std::max(std::min(most, (high - edges[0]) * per_slope), 0.0F));
    return {static_cast<uint32_t>(begin + (edges[begin + 1] < low) - ((begin > 0) & (edges[begin] >= low))),
            static_cast<uint32_t>(end + !(edges[end] > high) + ((end < last) & !(edges[end + 1] > high)))};
}

// Lights by slice, rising: those of slice s are slice_lights[slice_ends[s - 1], slice_ends[s]).
void sort_by_slice(const LightGridData& grid, const Edges& edges, std::span<const LightBounds> lights,
                   LightLists::Scratch& scratch) {
    const auto slices_of = [&](const LightBounds& light) {
        return slices_between(grid, edges.z, light.center.z - light.radius, light.center.z + light.radius);
    };
    // Differences become counts, counts the places where slices begin, and these, as the lights are put in, their ends.
    auto& ends = scratch.slice_ends;
    ends.assign(edges.z.size(), 0);
    for (const LightBounds& light : lights) {
        const Range slices = slices_of(light);
        ++ends[slices.begin];
        --ends[slices.end];
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), 0U);
    scratch.slice_lights.resize(ends.back());
    for (uint32_t i = 0; i < lights.size(); ++i) {
        const Range slices = slices_of(lights[i]);
        for (uint32_t s = slices.begin; s < slices.end; ++s) scratch.slice_lights[ends[s]++] = i;
    }
}

// Discs whose slopes are found many at once: arrays, for vector code.
struct DiscBatch {
    static constexpr uint32_t kCapacity = 256;
    std::array<float, kCapacity> across, z, radius_squared, z_low, z_high;
    std::array<float, kCapacity> slope_low, slope_high;
    std::array<uint32_t, kCapacity> light;  // whose sphere it is of
    uint32_t count = 0;

    void find_slopes() {
        const uint32_t filled = count;  // GCC 12 makes no vector code of a loop up to a member
        for (uint32_t i = 0; i < filled; ++i) {
            const auto slopes = shared::disc_slopes(across[i], z[i], radius_squared[i], z_low[i], z_high[i]);
            slope_low[i] = slopes.x;
            slope_high[i] = slopes.y;
        }
    }
};

// Finds the runs of one slice after another.
class RunFinder {
  public:
    RunFinder(const LightGridData& grid, const Edges& edges, std::span<const LightBounds> lights,
              std::span<const DepthRange> tile_depths, uint32_t first_light, std::vector<CellRun>& runs)
        : tiles_x_(grid.tiles_x),
          edges_(edges),
          lights_(lights),
          tile_depths_(tile_depths),
          first_light_(first_light),
          runs_(runs),
          columns_per_slope_(1.0F / (edges.x[1] - edges.x[0])),
          rows_per_slope_(1.0F / (edges.y[1] - edges.y[0])),
          margin_(tile_depths.empty() ? 0.0F : kTileMargin),
          touched_(grid.tiles_x) {}

    void find(std::span<const uint32_t> indices, float slice_low, float slice_high) {
        runs_.clear();
        while (!indices.empty()) {
            const auto batch = indices.first(std::min<size_t>(indices.size(), DiscBatch::kCapacity));
            find_rows(batch, slice_low, slice_high);
            indices = indices.subspan(batch.size());
        }
        find_columns();
    }

  private:
    // The lights' spheres cut by the slice, seen from the side: discs whose slopes are rows.
    void find_rows(std::span<const uint32_t> indices, float slice_low, float slice_high) {
        spheres_.count = static_cast<uint32_t>(indices.size());
        for (uint32_t i = 0; i < indices.size(); ++i) {
            const LightBounds& light = lights_[indices[i]];
            spheres_.across[i] = light.center.y;
            spheres_.z[i] = light.center.z;
            spheres_.radius_squared[i] = light.radius * light.radius;
            spheres_.z_low[i] = std::max(slice_low, light.center.z - light.radius);
            spheres_.z_high[i] = std::min(slice_high, light.center.z + light.radius);
            spheres_.light[i] = indices[i];
        }
        spheres_.find_slopes();
        for (uint32_t i = 0; i < spheres_.count; ++i) add_rows(i);
    }

    // A row of the sphere, seen from above: a disc whose slopes are columns.
    void add_rows(uint32_t i) {
        const float z_low = spheres_.z_low[i], z_high = spheres_.z_high[i];
        const float beside_z = shared::distance_outside(spheres_.z[i], z_low, z_high);
        const float margin = margin_ / rows_per_slope_;
        const Range rows =
            tiles_between(edges_.y, rows_per_slope_, spheres_.slope_low[i] - margin, spheres_.slope_high[i] + margin);
        for (uint32_t row = rows.begin; row < rows.end; ++row) {
            const float beside_y =
                shared::distance_across(spheres_.across[i], edges_.y[row], edges_.y[row + 1], z_low, z_high);
            const float radius_squared = spheres_.radius_squared[i] - beside_y * beside_y;
            if (beside_z * beside_z > radius_squared) continue;
            if (rows_.count == DiscBatch::kCapacity) find_columns();
            const uint32_t at = rows_.count++;
            rows_.across[at] = lights_[spheres_.light[i]].center.x;
            rows_.z[at] = spheres_.z[i];
            rows_.radius_squared[at] = radius_squared;
            rows_.z_low[at] = z_low;
            rows_.z_high[at] = z_high;
            rows_.light[at] = spheres_.light[i];
            row_[at] = row;
        }
    }

    void find_columns() {
        rows_.find_slopes();
        const float margin = margin_ / columns_per_slope_;
        for (uint32_t i = 0; i < rows_.count; ++i) {
            const Range columns =
                tiles_between(edges_.x, columns_per_slope_, rows_.slope_low[i] - margin, rows_.slope_high[i] + margin);
            if (columns.begin >= columns.end) continue;
            if (!tile_depths_.empty()) {
                test_depths(i, columns);
                add_touched(i, columns);
            } else if (lights_[rows_.light[i]].cos_half_angle > 0.0F) {
                test_cone(i, columns);
                add_touched(i, columns);
            } else {
                add_run(i, columns);
            }
        }
        rows_.count = 0;
    }

    void test_depths(uint32_t i, Range columns) {
        const LightBounds light = lights_[rows_.light[i]];
        for (uint32_t x = columns.begin; x < columns.end; ++x) {
            const DepthRange depths = tile_depths_[row_[i] * tiles_x_ + x];
            touched_[x] = shared::light_touches_cell(light, cell(i, x, depths.low, depths.high)) ? 1 : 0;
        }
    }

    void test_cone(uint32_t i, Range columns) {
        const LightBounds light = lights_[rows_.light[i]];
        for (uint32_t x = columns.begin; x < columns.end; ++x) {
            touched_[x] = shared::cone_touches_cell(light, cell(i, x, rows_.z_low[i], rows_.z_high[i])) ? 1 : 0;
        }
    }

    CellBounds cell(uint32_t i, uint32_t x, float z_low, float z_high) const {
        return {{edges_.x[x], edges_.y[row_[i]], edges_.x[x + 1], edges_.y[row_[i] + 1]}, z_low, z_high};
    }

    void add_touched(uint32_t i, Range columns) {
        for (uint32_t x = columns.begin; x < columns.end; ++x) {
            if (touched_[x] == 0) continue;
            const uint32_t begin = x;
            while (x < columns.end && touched_[x] != 0) ++x;
            add_run(i, {begin, x});
        }
    }

    void add_run(uint32_t i, Range columns) {
        const uint32_t first_tile = row_[i] * tiles_x_;
        runs_.push_back({first_tile + columns.begin, first_tile + columns.end, first_light_ + rows_.light[i]});
    }

    uint32_t tiles_x_;
    const Edges& edges_;
    std::span<const LightBounds> lights_;
    std::span<const DepthRange> tile_depths_;
    uint32_t first_light_;
    std::vector<CellRun>& runs_;
    float columns_per_slope_, rows_per_slope_;
    float margin_;  // tiles
    DiscBatch spheres_, rows_;
    std::array<uint32_t, DiscBatch::kCapacity> row_;  // of rows_
    std::vector<uint32_t> touched_;                   // of one row's columns, 0 or 1
};

// Turns one slice's runs into its cells' lists, from `offset` on, and returns where they end.
uint32_t fill_slice(LightLists::Scratch& scratch, uint32_t offset, size_t max_indices, std::span<CellList> cells,
                    std::vector<uint32_t>& indices) {
    size_t wanted = offset;
    for (const CellRun& run : scratch.runs) wanted += run.end - run.begin;
    if (wanted > max_indices) {
        throw EnvironmentError(fmt::format("light lists: more than {} indices of lights in cells", max_indices));
    }
    // Differences become counts, and these the places where the lists begin.
    auto& places = scratch.places;
    places.assign(cells.size() + 1, 0);
    for (const CellRun& run : scratch.runs) {
        ++places[run.begin];
        --places[run.end];
    }
    uint32_t count = 0;
    for (size_t i = 0; i < cells.size(); ++i) {
        count += places[i];
        cells[i] = {offset, count};
        places[i] = offset;
        offset += count;
    }
    if (offset > indices.size()) indices.resize(size_t{offset} + offset / 2);
    for (const CellRun& run : scratch.runs) {
        for (uint32_t tile = run.begin; tile < run.end; ++tile) indices[places[tile]++] = run.light;
    }
    return offset;
}

}  // namespace

LightGridData make_light_grid(const LightGridDesc& desc, const FrameSetup& setup, std::span<const LightBounds> lights) {
    CHECK_THAT(desc.tile_px > 0, "tile_px = {}", desc.tile_px);
    CHECK(!(desc.slices && desc.depth_bounds));
    const double tan_y = std::tan(glm::radians(setup.camera.fov_y_deg) / 2.0);
    const double tan_x = tan_y * setup.width / setup.height;
    LightGridData grid{};
    grid.tile_px = desc.slices ? cluster_tile_px(desc.tile_px, setup.height) : static_cast<uint32_t>(desc.tile_px);
    grid.tiles_x = tiles_along(setup.width, grid.tile_px);
    grid.tiles_y = tiles_along(setup.height, grid.tile_px);
    grid.tangent_per_px_x = static_cast<float>(2.0 * tan_x / setup.width);
    grid.tangent_per_px_y = static_cast<float>(2.0 * tan_y / setup.height);
    grid.tan_x = static_cast<float>(tan_x);
    grid.tan_y = static_cast<float>(tan_y);
    grid.word_count = static_cast<uint32_t>((lights.size() + 31) / 32);

    const DepthExtent reached = depth_extent(lights);
    const double far = setup.camera.far_distance * kBeyondFar;
    const double last_end = reached.high > 0.0 ? std::min(reached.high, far) : far;
    const double first_end = std::max({setup.camera.near_distance, reached.low, last_end * kFirstSliceEnd});
    const uint32_t most = std::clamp(kMaxCells / (grid.tiles_x * grid.tiles_y), 1U, kMaxSlices);
    grid.slices = 1;
    if (desc.slices && reached.high > 0.0 && first_end < last_end) {
        const double growth = std::max(1.0 + kElongation * grid.tile_px * grid.tangent_per_px_y, kLeastGrowth);
        const double wanted = 1.0 + std::ceil(std::log(last_end / first_end) / std::log(growth));
        grid.slices = static_cast<uint32_t>(std::min<double>(wanted, most));
    }
    // The second slice begins at `first_end`, and one after the last would at `last_end`.
    const double scale = grid.slices == 1 ? 1.0 : (grid.slices - 1) / std::log2(last_end / first_end);
    grid.slice_scale = static_cast<float>(scale);
    grid.slice_offset = static_cast<float>(grid.slices - std::log2(last_end) * scale);
    return grid;
}

void build_light_lists(const LightGridData& grid, std::span<const LightBounds> lights,
                       std::span<const DepthRange> tile_depths, uint32_t first_light, LightLists& lists,
                       size_t max_indices) {
    const size_t tiles = size_t{grid.tiles_x} * grid.tiles_y;
    CHECK_THAT(tile_depths.empty() || (grid.slices == 1 && tile_depths.size() == tiles),
               "{} depth ranges for {} tiles of {} slices", tile_depths.size(), tiles, grid.slices);
    Edges edges(grid);
    // What a tile shows bounds its cell, not the slice.
    if (!tile_depths.empty()) edges.z.back() = std::numeric_limits<float>::infinity();
    LightLists::Scratch& scratch = lists.scratch;
    sort_by_slice(grid, edges, lights, scratch);
    RunFinder finder(grid, edges, lights, tile_depths, first_light, scratch.runs);
    lists.cells.resize(cell_count(grid));
    uint32_t first = 0, offset = 0;
    for (uint32_t s = 0; s < grid.slices; ++s) {
        const uint32_t end = scratch.slice_ends[s];
        finder.find(std::span(scratch.slice_lights).subspan(first, end - first), edges.z[s], edges.z[s + 1]);
        offset =
            fill_slice(scratch, offset, max_indices, std::span(lists.cells).subspan(s * tiles, tiles), lists.indices);
        first = end;
    }
    lists.indices.resize(offset);
}

}  // namespace lightsweep
