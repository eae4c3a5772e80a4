#include "bench/metrics/metrics.h"
#include "bench/metrics/relative_error.h"

namespace lightsweep {
namespace {

std::vector<std::optional<double>> max_rel(const ImagePair& pair) {
    const auto of_row = [&](int y) {
        std::optional<double> most;
        for (int x = 0; x < pair.width(); ++x)
            most = std::max(most, relative_error(pair.reference_linear.pixel(x, y), pair.test_linear.pixel(x, y)));
        return most;
    };
    // An absent value is less than any other.
    const auto larger = [](std::optional<double> a, std::optional<double> b) { return std::max(a, b); };
    return {reduce_rows<std::optional<double>>(pair.height(), of_row, larger)};
}

constexpr std::string_view kValues[] = {"max_rel"};

}  // namespace

extern const Metric metric_max_rel{.key = "max_rel",
                                   .summary = "largest relative error of a pixel, of linear values",
                                   .values = kValues,
                                   .measure = max_rel};

}  // namespace lightsweep
