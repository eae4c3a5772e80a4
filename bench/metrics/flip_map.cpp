// Rows are taken in bands: a band's rows, and as many above and below as the filters reach, become opponent colours and
// are filtered along the row; then each row of the band is filtered across, and compared. A band stays in the cache and
// needs nothing of the others, so that the result does not depend on the number of threads.
#include "bench/metrics/flip_map.h"

#include "bench/metrics/flip_color.h"
#include "bench/metrics/flip_filters.h"
#include "bench/metrics/reduce.h"
#include "renderer/base/check.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace lightsweep {
namespace {

using flip_color::unit;

constexpr int kBandRows = 64;

/// One picture's rows of a band, filtered along the row.
struct AlongRows {
    Rows<float> achromatic, red_green, wide_blue_yellow, narrow_blue_yellow, gaussian, edge, point;
    AlongRows(int rows, int width)
        : achromatic(rows, width),
          red_green(rows, width),
          wide_blue_yellow(rows, width),
          narrow_blue_yellow(rows, width),
          gaussian(rows, width),
          edge(rows, width),
          point(rows, width) {}
};

/// One row of a picture, filtered along and across. Edges and points are those along x and those along y.
struct FilteredRow {
    Rows<float> lab, edges, points;
    explicit FilteredRow(int width) : lab(3, width), edges(2, width), points(2, width) {}
};

/// How far two filtered rows are apart in colour, in [0, 1]: the HyAB distance (section 4.1.3), then the larger ones
/// pressed together (4.1.4).
void color_difference(const Rows<float>& r, const Rows<float>& v, float* __restrict out, int count) {
    constexpr float kPower = 0.7F;    // q_c
    constexpr float kKnee = 0.4F;     // p_c, of the largest distance
    constexpr float kAtKnee = 0.95F;  // p_t
    const auto distance = [](const float* r0, const float* r1, const float* r2, const float* v0, const float* v1,
                             const float* v2, float* __restrict to, int n) {
        for (int i = 0; i < n; ++i) {
            const float a = r1[i] - v1[i], b = r2[i] - v2[i];
            to[i] = std::abs(r0[i] - v0[i]) + std::sqrt(a * a + b * b);
        }
        for (int i = 0; i < n; ++i) to[i] = vector_pow(to[i], kPower);
    };
    // Between green and blue, which are the farthest apart.
    static const float largest = [&] {
        float green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
        for (float* color : {green, blue}) {
            flip_color::to_opponent(color, color + 1, color + 2, 1);
            flip_color::to_hunt_lab(color, color + 1, color + 2, 1);
        }
        float most = 0;
        distance(green, green + 1, green + 2, blue, blue + 1, blue + 2, &most, 1);
        return most;
    }();
    distance(r[0], r[1], r[2], v[0], v[1], v[2], out, count);
    const float knee = kKnee * largest;
    const float slope = kAtKnee / knee, slope_above = (1 - kAtKnee) / (largest - knee);
    for (int i = 0; i < count; ++i) {
        const float above = kAtKnee + (out[i] - knee) * slope_above;
        out[i] = unit(out[i] < knee ? out[i] * slope : above);
    }
}

/// How far two filtered rows are apart in edges and points, in [0, 1] (section 4.2).
void feature_difference(const FilteredRow& r, const FilteredRow& v, float* __restrict out, int count) {
    const auto change = [](const Rows<float>& a, const Rows<float>& b, int i) {
        return std::abs(std::sqrt(a[0][i] * a[0][i] + a[1][i] * a[1][i]) -
                        std::sqrt(b[0][i] * b[0][i] + b[1][i] * b[1][i]));
    };
    for (int i = 0; i < count; ++i) {
        const float larger = std::max(change(r.edges, v.edges, i), change(r.points, v.points, i));
        out[i] = std::sqrt(0.70710678F * larger);  // to the power q_f = 0.5
    }
}

/// The workspace of one thread.
class Band {
  public:
    Band(const Image& reference, const Image& test, const FlipFilters& filters)
        : images_{&reference, &test},
          filters_(filters),
          width_(reference.width),
          height_(reference.height),
          reach_(filters.radius),
          along_(2, AlongRows(kBandRows + 2 * reach_, width_)),
          filtered_(2, FilteredRow(width_)),
          opponent_(3, width_ + 2 * reach_ + kRowBlock),
          scratch_(2, width_),
          taps_(static_cast<size_t>(2 * reach_ + 1)) {}

    /// Raises the rows [first, end) of the map to the error under each of `shows`.
    void raise(int first, int end, std::span<const Show> shows, FlipMap& map) {
        top_ = std::max(0, first - reach_);
        const int bottom = std::min(height_, end + reach_);
        if (same_rows(bottom)) return;
        for (const Show& show : shows) {
            for (int y = top_; y < bottom; ++y)
                for (size_t picture = 0; picture < 2; ++picture) filter_along(picture, y, show);
            for (int y = first; y < end; ++y) {
                for (size_t picture = 0; picture < 2; ++picture) filter_across(picture, y);
                compare(&map.error[static_cast<size_t>(y) * static_cast<size_t>(width_)]);
            }
        }
    }

  private:
    bool same_rows(int bottom) const {
        const auto bytes = static_cast<size_t>(bottom - top_) * static_cast<size_t>(width_) * 3 * sizeof(float);
        return std::memcmp(images_[0]->pixel(0, top_), images_[1]->pixel(0, top_), bytes) == 0;
    }

    void filter_along(size_t picture, int y, const Show& show) {
        const std::array<float*, 3> channels{opponent_[0] + reach_, opponent_[1] + reach_, opponent_[2] + reach_};
        load(picture, y, channels);
        for (float* channel : channels) show({channel, static_cast<size_t>(width_)});
        flip_color::to_opponent(channels[0], channels[1], channels[2], width_);
        for (float* channel : channels) {  // the border's pixel goes on beyond it
            std::fill(channel - reach_, channel, channel[0]);
            std::fill(channel + width_, channel + padded_width(width_) + reach_, channel[width_ - 1]);
        }
        const auto take = [&](const float* channel) {
            for (int k = -reach_; k <= reach_; ++k) *tap(k) = channel + k;
        };
        const auto filter = [&](const RowFilter<float>& along, Rows<float>& out) {
            along.apply(tap(0), out[y - top_], width_);
        };
        AlongRows& out = along_[picture];
        take(channels[0]);
        filter(filters_.achromatic, out.achromatic);
        filter(filters_.gaussian, out.gaussian);
        filter(filters_.edge, out.edge);
        filter(filters_.point, out.point);
        take(channels[1]);
        filter(filters_.red_green, out.red_green);
        take(channels[2]);
        filter(filters_.wide_blue_yellow, out.wide_blue_yellow);
        filter(filters_.narrow_blue_yellow, out.narrow_blue_yellow);
    }

    /// A pixel that is not finite in either picture is black in both.
    void load(size_t picture, int y, const std::array<float*, 3>& channels) const {
        const float* values = images_[picture]->pixel(0, y);
        for (int x = 0; x < width_; ++x)
            for (size_t c = 0; c < 3; ++c) channels[c][x] = values[3 * static_cast<size_t>(x) + c];
        const auto count = 3 * static_cast<size_t>(width_);
        if (all_finite({images_[0]->pixel(0, y), count}) && all_finite({images_[1]->pixel(0, y), count})) return;
        for (int x = 0; x < width_; ++x)
            if (!all_finite({images_[0]->pixel(x, y), 3}) || !all_finite({images_[1]->pixel(x, y), 3}))
                for (float* channel : channels) channel[x] = 0;
    }

    void filter_across(size_t picture, int y) {
        const auto filter = [&](const RowFilter<float>& across, const Rows<float>& in, float* out) {
            for (int k = -reach_; k <= reach_; ++k) *tap(k) = in[std::clamp(y + k, 0, height_ - 1) - top_];
            across.apply(tap(0), out, width_);
        };
        const AlongRows& in = along_[picture];
        FilteredRow& out = filtered_[picture];
        filter(filters_.achromatic, in.achromatic, out.lab[0]);
        filter(filters_.red_green, in.red_green, out.lab[1]);
        filter(filters_.wide_blue_yellow, in.wide_blue_yellow, out.lab[2]);
        filter(filters_.narrow_blue_yellow, in.narrow_blue_yellow, scratch_[0]);
        for (int x = 0; x < width_; ++x) out.lab[2][x] += scratch_[0][x];
        flip_color::to_hunt_lab(out.lab[0], out.lab[1], out.lab[2], width_);
        filter(filters_.gaussian, in.edge, out.edges[0]);
        filter(filters_.edge, in.gaussian, out.edges[1]);
        filter(filters_.gaussian, in.point, out.points[0]);
        filter(filters_.point, in.gaussian, out.points[1]);
    }

    /// `error`: a row of the map. NaN stays.
    void compare(float* __restrict error) {
        float* __restrict color = scratch_[0];
        float* __restrict feature = scratch_[1];
        color_difference(filtered_[0].lab, filtered_[1].lab, color, width_);
        feature_difference(filtered_[0], filtered_[1], feature, width_);
        for (int x = 0; x < width_; ++x) {
            const float both = unit(vector_pow(color[x], 1 - feature[x]));
            error[x] = both > error[x] ? both : error[x];
        }
    }

    const float** tap(int k) { return &taps_[static_cast<size_t>(k + reach_)]; }

    std::array<const Image*, 2> images_;
    const FlipFilters& filters_;
    int width_, height_, reach_;
    int top_ = 0;  ///< the row of the pictures that is row 0 of the band's
    std::vector<AlongRows> along_;
    std::vector<FilteredRow> filtered_;
    Rows<float> opponent_;  ///< with a border on either side
    Rows<float> scratch_;
    std::vector<const float*> taps_;
};

}  // namespace

FlipMap flip_map(const Image& reference, const Image& test, std::span<const Show> shows, double pixels_per_degree) {
    CHECK(reference.width == test.width && reference.height == test.height);
    FlipMap map{.width = reference.width, .height = reference.height, .error = {}, .exposures = {}};
    map.error.resize(reference.pixel_count());
    const FlipFilters filters = flip_filters(pixels_per_degree);
    tbb::enumerable_thread_specific<Band> bands([&] { return Band(reference, test, filters); });
    const int count = (map.height + kBandRows - 1) / kBandRows;
    tbb::parallel_for(0, count, [&](int band) {
        const int first = band * kBandRows, end = std::min(map.height, first + kBandRows);
        for (int y = first; y < end; ++y)
            for (int x = 0; x < map.width; ++x)
                if (!all_finite({reference.pixel(x, y), 3}) || !all_finite({test.pixel(x, y), 3}))
                    map.error[static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)] =
                        std::numeric_limits<float>::quiet_NaN();
        bands.local().raise(first, end, shows, map);
    });
    return map;
}

}  // namespace lightsweep
