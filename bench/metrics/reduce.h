// The loop under the metrics: a reduction over the finite pixels of two images, on all cores, whose result does not
// depend on the number of threads. Rows are taken in blocks of a fixed size; each block's result is kept, and all are
// combined in order. Inside a block eight accumulators run side by side, so that the compiler may use vectors without
// reordering sums.
#pragma once

#include "renderer/base/check.h"
#include "renderer/image/image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

/// Without library calls or branches, so that a loop over it becomes vector code.
inline bool is_finite(float v) { return (std::bit_cast<uint32_t>(v) & 0x7f800000U) != 0x7f800000U; }

inline bool all_finite(std::span<const float> values) {
    uint32_t infinite = 0;
    for (const float v : values) infinite |= is_finite(v) ? 0U : 1U;
    return infinite == 0;
}

/// One result per block of rows, in order: what `of_block(first, end)` gives for its rows [first, end), combined.
template <typename Result, typename OfBlock, typename Combine>
Result reduce_blocks(int height, OfBlock of_block, Combine combine) {
    constexpr int kBlockRows = 16;
    const int blocks = (height + kBlockRows - 1) / kBlockRows;
    std::vector<Result> results(static_cast<size_t>(blocks));
    tbb::parallel_for(0, blocks, [&](int block) {
        const int first = block * kBlockRows;
        results[static_cast<size_t>(block)] = of_block(first, std::min(height, first + kBlockRows));
    });
    Result result{};
    for (const Result& block : results) result = combine(result, block);
    return result;
}

/// What `of_row(y)` gives for each row, combined in order.
template <typename Result, typename OfRow, typename Combine>
Result reduce_rows(int height, OfRow of_row, Combine combine) {
    const auto of_block = [&](int first, int end) {
        Result result{};
        for (int y = first; y < end; ++y) result = combine(result, of_row(y));
        return result;
    };
    return reduce_blocks<Result>(height, of_block, combine);
}

struct Reduction {
    double value = 0;
    uint64_t values = 0;  ///< how many channel values took part: three per finite pixel
};

/// Combines `term(r, v)` (doubles, finite) over every channel of every pixel that is finite in both images, starting at
/// 0.
template <typename Term, typename Combine>
Reduction reduce_finite(const Image& reference, const Image& test, Term term, Combine combine) {
    CHECK(reference.width == test.width && reference.height == test.height);
    constexpr size_t kLanes = 8;
    const auto of_values = [&](std::span<const float> r, std::span<const float> v) {
        double lanes[kLanes] = {};
        size_t i = 0;
        for (; i + kLanes <= r.size(); i += kLanes)
            for (size_t k = 0; k < kLanes; ++k)
                lanes[k] = combine(lanes[k], term(static_cast<double>(r[i + k]), static_cast<double>(v[i + k])));
        for (size_t k = 0; i + k < r.size(); ++k)
            lanes[k] = combine(lanes[k], term(static_cast<double>(r[i + k]), static_cast<double>(v[i + k])));
        double value = 0;
        for (const double lane : lanes) value = combine(value, lane);
        return Reduction{value, r.size()};
    };
    const auto of_row = [&](int y) {
        const size_t count = size_t{3} * static_cast<size_t>(reference.width);
        const std::span<const float> r(reference.pixel(0, y), count);
        const std::span<const float> v(test.pixel(0, y), count);
        if (all_finite(r) && all_finite(v)) return of_values(r, v);
        std::vector<float> finite_r, finite_v;
        for (size_t i = 0; i < count; i += 3) {
            if (!all_finite(r.subspan(i, 3)) || !all_finite(v.subspan(i, 3))) continue;
            finite_r.insert(finite_r.end(), &r[i], &r[i] + 3);
            finite_v.insert(finite_v.end(), &v[i], &v[i] + 3);
        }
        return of_values(finite_r, finite_v);
    };
    return reduce_rows<Reduction>(reference.height, of_row, [&](Reduction a, Reduction b) {
        return Reduction{combine(a.value, b.value), a.values + b.values};
    });
}

inline constexpr auto kSum = [](double a, double b) { return a + b; };
inline constexpr auto kMax = [](double a, double b) { return a > b ? a : b; };
inline constexpr auto kSquaredDifference = [](double r, double v) { return (v - r) * (v - r); };

}  // namespace lightsweep
