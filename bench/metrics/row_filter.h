// One-dimensional filters over rows of a picture, the loop under FLIP and SSIM. The same loop filters along a row (the
// taps are that row, shifted) and across rows (the taps are its neighbours). Written so that it becomes vector code.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace lightsweep {

/// Rows are filtered in whole blocks of this many values, so they must have room for them.
inline constexpr int kRowBlock = 16;
constexpr int padded_width(int width) { return (width + kRowBlock - 1) / kRowBlock * kRowBlock; }

/// What is known of the half of a filter that is not kept.
enum class FilterKind {
    even,      ///< the same as the other
    odd,       ///< its opposite; the middle is 0
    zero_sum,  ///< even, and all weights sum to 0: taken over differences to the middle, so that flat gives exactly 0
};

/// 2 * radius + 1 weights, of which one half is kept: weights[k] is that of the tap k to the right, or below.
template <typename T>
struct RowFilter {
    std::vector<T> weights;
    FilterKind kind = FilterKind::even;

    int radius() const { return static_cast<int>(weights.size()) - 1; }

    /// out[x] = sum over k in [-radius, radius] of the weight k times taps[k][x], for x in [0, padded_width(width)).
    /// `taps` points at the middle one of at least 2 * radius + 1 rows.
    void apply(const T* const* taps, T* out, int width) const {
        switch (kind) {
            case FilterKind::even:
                return sum<FilterKind::even>(taps, out, width);
            case FilterKind::odd:
                return sum<FilterKind::odd>(taps, out, width);
            case FilterKind::zero_sum:
                return sum<FilterKind::zero_sum>(taps, out, width);
        }
    }

  private:
    template <FilterKind known_kind>
    void sum(const T* const* taps, T* __restrict out, int width) const {
        for (int x = 0; x < width; x += kRowBlock) {
            const T* middle = taps[0] + x;
            std::array<T, kRowBlock> total{};
            if constexpr (known_kind == FilterKind::even)
                for (int i = 0; i < kRowBlock; ++i) total[i] = weights[0] * middle[i];
            for (int k = 1; k <= radius(); ++k) {
                const T weight = weights[k];
                const T* after = taps[k] + x;
                const T* before = taps[-k] + x;
                for (int i = 0; i < kRowBlock; ++i) {
                    if constexpr (known_kind == FilterKind::odd) {
                        total[i] += weight * (after[i] - before[i]);
                    } else if constexpr (known_kind == FilterKind::zero_sum) {
                        total[i] += weight * ((after[i] - middle[i]) + (before[i] - middle[i]));
                    } else {
                        total[i] += weight * (after[i] + before[i]);
                    }
                }
            }
            for (int i = 0; i < kRowBlock; ++i) out[x + i] = total[i];
        }
    }
};

/// Rows of one width, with room for whole blocks. Zero at first.
template <typename T>
class Rows {
  public:
    Rows(int count, int width)
        : stride_(static_cast<size_t>(padded_width(width))), values_(static_cast<size_t>(count) * stride_) {}
    T* operator[](int row) { return &values_[static_cast<size_t>(row) * stride_]; }
    const T* operator[](int row) const { return &values_[static_cast<size_t>(row) * stride_]; }

  private:
    size_t stride_;
    std::vector<T> values_;
};

}  // namespace lightsweep
