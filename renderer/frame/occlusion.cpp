#include "renderer/frame/occlusion.h"

#include "renderer/base/check.h"
#include "renderer/frame/cull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace lightsweep {
namespace {

// What is rounded below, with a unit of 2^-24: slopes, by less than 16 of them; pixel coordinates, which are at most
// 2^15, by less than a hundredth of a pixel. Rasterisers move vertices to 1/256 of a pixel.
constexpr float kSlopeRounding = 0x1p-20F;
constexpr float kPixelMargin = 1.0F / 8.0F;

// Of a view distance z, from a depth that is stored relatively: a few units, many times over. Standard depth, about
// 1 - near / z, is off by units absolutely, and so z by z^2 / near times as many.
constexpr float kDistanceRounding = 0x1p-18F;
constexpr float kDepthRounding = 0x1p-22F;

// What rectangles of spheres, in tiles, are computed from.
struct TileView {
    float near;
    float tiles_per_slope_x, tiles_per_slope_y;
    float center_x, center_y;  // tiles to where the slope is 0
    float margin;              // tiles
    float last_x, last_y;
    float error_per_z, error_per_z_squared;

    TileView(const FrameSetup& setup, int tile_px) {
        const double tan_y = std::tan(glm::radians(setup.camera.fov_y_deg) / 2.0);
        const double tan_x = tan_y * setup.width / setup.height;
        near = static_cast<float>(setup.camera.near_distance);
        center_x = static_cast<float>(0.5 * setup.width / tile_px);
        center_y = static_cast<float>(0.5 * setup.height / tile_px);
        tiles_per_slope_x = static_cast<float>(0.5 * setup.width / tile_px / tan_x);
        tiles_per_slope_y = static_cast<float>(0.5 * setup.height / tile_px / tan_y);
        margin = kPixelMargin / static_cast<float>(tile_px);
        last_x = static_cast<float>((setup.width - 1) / tile_px);
        last_y = static_cast<float>((setup.height - 1) / tile_px);
        error_per_z = kDistanceRounding;
        error_per_z_squared = setup.convention == DepthConvention::standard ? kDepthRounding / near : 0.0F;
    }
};

// Tiles [x0, x1] x [y0, y1] that hold spheres, and the view distance that these begin at. Arrays, for vector code.
struct SphereTiles {
    static constexpr size_t kCapacity = 256;
    std::array<int32_t, kCapacity> x0, y0, x1, y1;
    std::array<float, kCapacity> nearest;  // 0: touches the near side, and the tiles say nothing

    void find(std::span<const glm::vec4> spheres, const TileView& view);
};

struct TileRange {
    float first, last;
};

// Of a disc of radius r around (across, z), z > r: the lines from the eye that touch it have the slopes
// (across z +- r t) / room, where t^2 = across^2 + room and room = z^2 - r^2. Tiles beside the picture become
// those at its edge. What is no number is everywhere.
inline TileRange tiles_of_disc(float across, float z, float radius, float room, float tiles_per_room, float center,
                               float margin, float last) {
    const float middle = across * z, wide = radius * std::sqrt(across * across + room);
    const float half = wide + kSlopeRounding * (std::abs(middle) + wide);
    const float low = (middle - half) * tiles_per_room + center - margin;
    const float high = (middle + half) * tiles_per_room + center + margin;
    return {std::min(std::max(0.0F, low), last), std::max(std::min(last, high), 0.0F)};
}

void SphereTiles::find(std::span<const glm::vec4> spheres, const TileView& tile_view) {
    CHECK_THAT(spheres.size() <= kCapacity, "{} spheres", spheres.size());
    const TileView view = tile_view;
    const size_t count = spheres.size();
    const glm::vec4* all = spheres.data();
    for (size_t i = 0; i < count; ++i) {
        const float z = all[i].z, radius = all[i].w;
        const float begin = z - radius;
        const float room = std::max(begin * (z + radius), 1e-30F);
        const float inverse_room = 1.0F / room;
        const TileRange x = tiles_of_disc(all[i].x, z, radius, room, view.tiles_per_slope_x * inverse_room,
                                          view.center_x, view.margin, view.last_x);
        const TileRange y = tiles_of_disc(all[i].y, z, radius, room, view.tiles_per_slope_y * inverse_room,
                                          view.center_y, view.margin, view.last_y);
        x0[i] = static_cast<int32_t>(x.first);
        x1[i] = static_cast<int32_t>(x.last);
        y0[i] = static_cast<int32_t>(y.first);
        y1[i] = static_cast<int32_t>(y.last);
        const float rounding = begin * (view.error_per_z + view.error_per_z_squared * begin);
        nearest[i] = begin > view.near ? begin - rounding : 0.0F;
    }
}

// Those of `from` that `keep` says, called with places in from.instances, in their order.
template <class Keep>
void filter(const DrawList& from, Keep keep, DrawList& kept) {
    kept.clear();
    for (const DrawCall& draw : from.draws) {
        const auto first = static_cast<uint32_t>(kept.instances.size());
        for (uint32_t place = draw.first_visible; place < draw.first_visible + draw.instance_count; ++place) {
            if (keep(place)) kept.instances.push_back(from.instances[place]);
        }
        const auto count = static_cast<uint32_t>(kept.instances.size()) - first;
        if (count > 0) kept.draws.push_back({draw.batch, count, first});
    }
}

}  // namespace

void DepthPyramid::build(std::span<const float> farthest, int tiles_x, int tiles_y) {
    CHECK_THAT(
        tiles_x > 0 && tiles_y > 0 && farthest.size() == static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y),
        "{} tiles of {} x {}", farthest.size(), tiles_x, tiles_y);
    const auto longest = static_cast<unsigned>(std::max(tiles_x, tiles_y));
    levels_.resize(static_cast<size_t>(std::bit_width(longest - 1)) + 1);
    levels_[0].width = tiles_x;
    levels_[0].height = tiles_y;
    levels_[0].texels.assign(farthest.begin(), farthest.end());
    for (size_t l = 1; l < levels_.size(); ++l) {
        const Level& fine = levels_[l - 1];
        Level& coarse = levels_[l];
        coarse.width = (fine.width + 1) / 2;
        coarse.height = (fine.height + 1) / 2;
        coarse.texels.clear();
        for (int y = 0; y < fine.height; y += 2) {
            for (int x = 0; x < fine.width; x += 2) {
                const int right = std::min(x + 1, fine.width - 1), above = std::min(y + 1, fine.height - 1);
                coarse.texels.push_back(fine.farthest(x, y, right, above));
            }
        }
    }
}

float DepthPyramid::Level::farthest(int x0, int y0, int x1, int y1) const {
    const float* low = texels.data() + static_cast<ptrdiff_t>(y0) * width;
    const float* high = texels.data() + static_cast<ptrdiff_t>(y1) * width;
    return std::max(std::max(low[x0], low[x1]), std::max(high[x0], high[x1]));
}

float DepthPyramid::farthest(int x0, int y0, int x1, int y1) const {
    CHECK_THAT(0 <= x0 && x0 < x1 && x1 <= levels_[0].width && 0 <= y0 && y0 < y1 && y1 <= levels_[0].height,
               "[{}, {}) x [{}, {})", x0, x1, y0, y1);
    // Where squares are as long as the range they are at most two; squares of half that length may be two as well.
    const auto longest = static_cast<unsigned>(std::max(x1 - x0, y1 - y0));
    auto level = static_cast<unsigned>(std::bit_width(longest - 1));
    const auto at_most_two = [&](unsigned l) {
        return ((x1 - 1) >> l) - (x0 >> l) < 2 && ((y1 - 1) >> l) - (y0 >> l) < 2;
    };
    if (level > 0 && at_most_two(level - 1)) --level;
    return levels_[level].farthest(x0 >> level, y0 >> level, (x1 - 1) >> level, (y1 - 1) >> level);
}

void find_hidden_spheres(std::span<const glm::vec4> spheres, const FrameSetup& setup, const DepthPyramid& pyramid,
                         int tile_px, std::span<uint8_t> hidden) {
    CHECK_THAT(hidden.size() == spheres.size(), "{} flags for {} spheres", hidden.size(), spheres.size());
    const TileView view(setup, tile_px);
    SphereTiles tiles;
    for (size_t begin = 0; begin < spheres.size(); begin += SphereTiles::kCapacity) {
        const auto some = spheres.subspan(begin, std::min(spheres.size() - begin, SphereTiles::kCapacity));
        tiles.find(some, view);
        for (size_t i = 0; i < some.size(); ++i) {
            const bool behind =
                tiles.nearest[i] > 0.0F &&
                tiles.nearest[i] > pyramid.farthest(tiles.x0[i], tiles.y0[i], tiles.x1[i] + 1, tiles.y1[i] + 1);
            hidden[begin + i] = behind ? 1 : 0;
        }
    }
}

void OcclusionCuller::begin(const GpuScene& scene, const Frame& frame) {
    const size_t count = scene.instance_bounds().size();
    if (scene_ != &scene || seen_.size() != count) {
        seen_.assign(count, 1);  // the first phase draws everything
        rests_left_ = 0;
        next_rests_ = 1;
    }
    rests_ = rests_left_ > 0;
    if (rests_) {
        --rests_left_;
        std::ranges::fill(seen_, uint8_t{1});
    }
    scene_ = &scene;
    frame_ = &frame;
    const auto& instances = frame.visible.instances;
    filter(
        frame.visible, [&](uint32_t place) { return seen_[instances[place]] != 0; }, seen_before_);
    newly_seen_.clear();
    visible_.clear();
    if (rests_) visible_ = frame.visible;
    hidden_instances_ = hidden_triangles_ = 0;
    saved_draws_ = 0;
}

void OcclusionCuller::find_hidden(const gl::Texture& tile_depths) {
    CHECK(frame_ != nullptr);
    const FrameSetup& setup = frame_->setup;
    const DrawList& all = frame_->visible;
    CHECK_THAT(tile_depths.width() * kTilePx >= setup.width && tile_depths.height() * kTilePx >= setup.height,
               "{} x {} tiles for {} x {} px", tile_depths.width(), tile_depths.height(), setup.width, setup.height);
    const std::vector<float> ranges = tile_depths.read_floats(2);
    std::vector<float> farthest(ranges.size() / 2);
    for (size_t i = 0; i < farthest.size(); ++i) farthest[i] = ranges[2 * i + 1];
    pyramid_.build(farthest, tile_depths.width(), tile_depths.height());

    const CameraBasis basis = camera_basis(setup.camera);
    const auto view_sphere = [&](uint32_t instance) {
        const InstanceBounds& bounds = scene_->instance_bounds()[instance];
        const glm::dvec3 center = basis.to_view(bounds.center - setup.camera.eye);
        const double radius = bounds.radius + double{kCullMargin} * (glm::length(center) + bounds.radius);
        return glm::vec4(glm::vec3(center), static_cast<float>(radius));
    };
    spheres_.resize(all.instances.size());
    std::ranges::transform(all.instances, spheres_.begin(), view_sphere);
    hidden_.resize(spheres_.size());
    find_hidden_spheres(spheres_, setup, pyramid_, kTilePx, hidden_);

    const auto seen_before = [&](uint32_t place) { return seen_[all.instances[place]] != 0; };
    filter(
        all, [&](uint32_t place) { return !seen_before(place) && hidden_[place] == 0; }, newly_seen_);
    filter(
        all, [&](uint32_t place) { return seen_before(place) || hidden_[place] == 0; }, visible_);
    hidden_instances_ = all.instances.size() - visible_.instances.size();
    saved_draws_ = static_cast<int64_t>(all.draws.size()) -
                   static_cast<int64_t>(seen_before_.draws.size() + newly_seen_.draws.size());
    const auto triangles = [&](const DrawList& list) {
        uint64_t sum = 0;
        for (const DrawCall& draw : list.draws) {
            sum += uint64_t{draw.instance_count} * (scene_->batches()[draw.batch].index_count / 3);
        }
        return sum;
    };
    hidden_triangles_ = triangles(all) - triangles(visible_);
    if (std::ranges::find(hidden_, uint8_t{1}) != hidden_.end()) {
        rests_left_ = 0;
        next_rests_ = 1;
    } else if (!rests_ && !hidden_.empty()) {
        rests_left_ = next_rests_;
        next_rests_ = std::min(2 * next_rests_, kMostRests);
    }

    std::ranges::fill(seen_, uint8_t{0});
    for (size_t place = 0; place < hidden_.size(); ++place) seen_[all.instances[place]] = hidden_[place] == 0 ? 1 : 0;
}

const DrawList& OcclusionCuller::draws(Instances which) const {
    switch (which) {
        case Instances::visible:
            return visible_;
        case Instances::seen_before:
            return seen_before_;
        case Instances::newly_seen:
            return newly_seen_;
    }
    CHECK_THAT(false, "which = {}", static_cast<int>(which));
}

}  // namespace lightsweep
