#include "renderer/frame/light_list_service.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/gl/context.h"
#include "renderer/gl/draw.h"
#include "shaders/shared/light_masks.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace lightsweep {
namespace {

// Of the kernels.
constexpr size_t kMaskGroup = 128, kListGroup = 64;

// Room before anything is known of the lists.
constexpr size_t kFirstIndices = 65536, kFirstIndicesPerCell = 32;

void check_limit(const char* what, size_t value, const char* limit, int64_t allowed) {
    if (value > static_cast<size_t>(allowed))
        throw EnvironmentError(fmt::format("light lists: {} {} are more than {}, {}", value, what, limit, allowed));
}

gl::TexelBuffer small_texels(const char* label, gl::Format format) {
    return gl::TexelBuffer(gl::Buffer(size_t{0}, label), format);
}

// Shaders read them as texels and write them as storage; both limits count.
size_t largest_index_count() {
    const gl::Limits& limits = gl::Context::current()->limits();
    return static_cast<size_t>(
        std::min(limits.max_texel_buffer_texels, limits.max_storage_block_bytes / int64_t{sizeof(uint32_t)}));
}

// `threads` in work groups of `group`, in one row.
void dispatch(size_t threads, size_t group) {
    const size_t groups = (threads + group - 1) / group;
    check_limit("work groups", groups, "max_compute_groups", gl::Context::current()->limits().max_compute_groups);
    gl::dispatch(static_cast<uint32_t>(groups), 1, 1);
}

// Few lights need many threads each to fill a GPU; of many, most are small and have work for few.
unsigned lane_bits(size_t lights) {
    constexpr size_t kThreads = 131072;
    return static_cast<unsigned>(std::bit_width(std::clamp(kThreads / lights, size_t{4}, size_t{32}))) - 1;
}

std::vector<DepthRange> read_ranges(const gl::Texture& tile_depths) {
    const std::vector<float> values = tile_depths.read_floats(2);
    std::vector<DepthRange> ranges(values.size() / 2);
    std::memcpy(ranges.data(), values.data(), values.size() * sizeof(float));
    return ranges;
}

}  // namespace

const std::vector<std::string>& list_builder_names() {
    static const std::vector<std::string> kNames = {"cpu", "compute"};
    return kNames;
}

LightListService::LightListService(const LightGridDesc& desc, ListBuilder builder, double position_error)
    : desc_(desc),
      builder_(builder),
      position_error_(position_error),
      grid_block_(sizeof(shared::LightGridData), "light grid"),
      cells_(small_texels("light cells", gl::Format::RG32UI)),
      indices_(small_texels("light indices", gl::Format::R32UI)) {
    if (builder == ListBuilder::cpu) return;
    bounds_texels_ = small_texels("light bounds", gl::Format::RGBA32F);
    masks_ = small_texels("light masks", gl::Format::R32UI);
    wanted_ = gl::Buffer(sizeof(Wanted), "wanted indices");
    mask_program_ = gl::Program({.compute = "lists/light_mask.comp.glsl"});
    list_program_ = gl::Program(
        {.compute = "lists/light_list.comp.glsl",
         .defines = desc.depth_bounds ? std::vector<std::string>{"DEPTH_BOUNDS"} : std::vector<std::string>{}});
}

void LightListService::build(const Frame& frame, const gl::Texture* tile_depths) {
    CHECK(desc_.depth_bounds == (tile_depths != nullptr));
    light_bounds(frame, position_error_, bounds_);
    grid_ = make_light_grid(desc_, frame.setup, bounds_);
    directional_count_ = frame.data.directional_count;
    if (builder_ == ListBuilder::cpu) {
        build_on_cpu(tile_depths);
    } else {
        build_on_gpu(tile_depths);
    }
}

void LightListService::build_on_cpu(const gl::Texture* tile_depths) {
    const std::vector<DepthRange> ranges =
        tile_depths == nullptr ? std::vector<DepthRange>{} : read_ranges(*tile_depths);
    build_light_lists(grid_, bounds_, ranges, directional_count_, lists_,
                      std::min(largest_index_count(), kMostListIndices));
    check_lengths(lists_.cells);
    cells_.write_items<CellList>(lists_.cells);
    indices_.write_items<uint32_t>(lists_.indices);
    grid_.index_capacity = static_cast<uint32_t>(lists_.indices.size());
    grid_block_.write(std::as_bytes(std::span(&grid_, 1)));
}

void LightListService::build_on_gpu(const gl::Texture* tile_depths) {
    const gl::Limits& limits = gl::Context::current()->limits();
    const size_t cells = cell_count(grid_);
    const size_t mask_bytes = size_t{row_count(grid_)} * row_words(grid_) * sizeof(uint32_t);
    check_limit("bytes of light masks", mask_bytes, "max_storage_block_bytes", limits.max_storage_block_bytes);
    check_limit("bytes of cells", cells * sizeof(CellList), "max_storage_block_bytes", limits.max_storage_block_bytes);
    cells_.reserve(cells);
    masks_.reserve(mask_bytes / sizeof(uint32_t));
    indices_.reserve(std::min(std::max(kFirstIndices, kFirstIndicesPerCell * cells), largest_index_count()));
    grid_.index_capacity = static_cast<uint32_t>(indices_.size_bytes() / sizeof(uint32_t));
    bounds_texels_.write_items<shared::LightBounds>(bounds_);
    grid_block_.write(std::as_bytes(std::span(&grid_, 1)));
    masks_.buffer().clear(mask_bytes);
    wanted_.clear(wanted_.size_bytes());

    grid_block_.bind_uniform(shared::kLightGridBlock);
    bounds_texels_.bind(shared::kLightBoundsUnit);
    masks_.bind(shared::kLightMaskUnit);
    if (tile_depths != nullptr) tile_depths->bind(shared::kTileDepthUnit);
    masks_.buffer().bind_storage(shared::kLightMaskBuffer);
    cells_.buffer().bind_storage(shared::kLightCellBuffer);
    indices_.buffer().bind_storage(shared::kLightIndexBuffer);
    wanted_.bind_storage(shared::kWantedBuffer);
    if (!bounds_.empty()) {
        const unsigned bits = lane_bits(bounds_.size());
        mask_program_.use();
        mask_program_.set_uint(shared::kLaneBitsUniform, bits);
        dispatch(bounds_.size() << bits, kMaskGroup);
        gl::memory_barrier();
    }
    list_program_.use();
    dispatch(cells, kListGroup);
    gl::memory_barrier();
}

void LightListService::bind() const {
    grid_block_.bind_uniform(shared::kLightGridBlock);
    cells_.bind(shared::kLightCellUnit);
    indices_.bind(shared::kLightIndexUnit);
}

LightListService::Wanted LightListService::read_wanted() const {
    Wanted wanted{};
    wanted_.read(std::as_writable_bytes(std::span(&wanted, 1)));
    return wanted;
}

// Shaders loop over the directional lights, then over a list: drivers that end long loops would lose its last lights.
void LightListService::check_lengths(std::span<const CellList> cells) const {
    const int64_t allowed = gl::Context::current()->limits().max_loop_rounds;
    if (directional_count_ + bounds_.size() <= static_cast<size_t>(allowed)) return;
    const size_t longest = std::ranges::max(cells, {}, &CellList::count).count;
    check_limit("lights for a cell", directional_count_ + longest, "max_loop_rounds", allowed);
}

bool LightListService::grow_if_cut_short() {
    if (builder_ == ListBuilder::cpu) return false;
    const auto [wanted, lists_cut, unused] = read_wanted();
    const gl::Limits& limits = gl::Context::current()->limits();
    if (lists_cut != 0) {
        throw EnvironmentError(
            fmt::format("light lists of {} lights: their builder loops more than max_loop_rounds, {}", bounds_.size(),
                        limits.max_loop_rounds));
    }
    if (wanted <= grid_.index_capacity) {
        if (directional_count_ + bounds_.size() > static_cast<size_t>(limits.max_loop_rounds)) {
            check_lengths(read().cells);
        }
        return false;
    }
    check_limit("indices", wanted, "max_texel_buffer_texels", limits.max_texel_buffer_texels);
    check_limit("bytes of indices", wanted * sizeof(uint32_t), "max_storage_block_bytes",
                limits.max_storage_block_bytes);
    indices_.reserve(std::min(wanted + wanted / 4, largest_index_count()));
    return true;
}

LightLists LightListService::read() const {
    if (builder_ == ListBuilder::cpu) return lists_;
    LightLists lists;
    lists.cells.resize(cell_count(grid_));
    cells_.buffer().read(std::as_writable_bytes(std::span(lists.cells)));
    std::vector<uint32_t> indices(std::min<uint64_t>(read_wanted().indices, grid_.index_capacity));
    indices_.buffer().read(std::as_writable_bytes(std::span(indices)));
    // The threads reserve their room in any order, more than they fill, and beyond the end.
    for (CellList& list : lists.cells) {
        const auto filled = std::span(indices).subspan(list.count == 0 ? 0 : list.offset, list.count);
        list.offset = static_cast<uint32_t>(lists.indices.size());
        lists.indices.insert(lists.indices.end(), filled.begin(), filled.end());
    }
    return lists;
}

size_t LightListService::memory_bytes() const {
    return grid_block_.size_bytes() + cells_.size_bytes() + indices_.size_bytes() + bounds_texels_.size_bytes() +
           masks_.size_bytes() + wanted_.size_bytes();
}

}  // namespace lightsweep
