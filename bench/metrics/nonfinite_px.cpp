#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <functional>

namespace lightsweep {
namespace {

std::optional<double> nonfinite_px(const Image& reference, const Image& test) {
    const auto of_row = [&](int y) {
        uint64_t count = 0;
        for (int x = 0; x < reference.width; ++x)
            count += all_finite({reference.pixel(x, y), 3}) && all_finite({test.pixel(x, y), 3}) ? 0 : 1;
        return count;
    };
    return static_cast<double>(reduce_rows<uint64_t>(reference.height, of_row, std::plus<>()));
}

}  // namespace

extern const Metric metric_nonfinite_px{
    .key = "nonfinite_px", .summary = "pixels with NaN or infinity in either image", .measure = nonfinite_px};

}  // namespace lightsweep
