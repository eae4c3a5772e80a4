#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <functional>

namespace lightsweep {
namespace {

std::vector<std::optional<double>> nonfinite_px(const ImagePair& pair) {
    const auto of_row = [&](int y) {
        uint64_t count = 0;
        for (int x = 0; x < pair.width(); ++x) {
            const bool finite =
                all_finite({pair.reference_linear.pixel(x, y), 3}) && all_finite({pair.test_linear.pixel(x, y), 3});
            count += finite ? 0 : 1;
        }
        return count;
    };
    return {static_cast<double>(reduce_rows<uint64_t>(pair.height(), of_row, std::plus<>()))};
}

constexpr std::string_view kValues[] = {"nonfinite_px"};

}  // namespace

extern const Metric metric_nonfinite_px{.key = "nonfinite_px",
                                        .summary = "pixels with NaN or infinity in either image",
                                        .values = kValues,
                                        .measure = nonfinite_px};

}  // namespace lightsweep
