// Percentiles of the pixels' relative errors, by linear interpolation between order statistics: type 7 of Hyndman and
// Fan, "Sample Quantiles in Statistical Packages", The American Statistician 50, 1996.
#include "bench/metrics/metrics.h"
#include "bench/metrics/relative_error.h"

#include <array>

namespace lightsweep {
namespace {

constexpr std::string_view kValues[] = {"rel_p50", "rel_p90", "rel_p99", "rel_p999"};
constexpr double kFractions[] = {0.5, 0.9, 0.99, 0.999};

std::vector<double> relative_errors(const ImagePair& pair) {
    const auto of_row = [&](int y) {
        std::vector<double> errors;
        for (int x = 0; x < pair.width(); ++x)
            if (const auto error = relative_error(pair.reference_linear.pixel(x, y), pair.test_linear.pixel(x, y)))
                errors.push_back(*error);
        return errors;
    };
    const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
        all.insert(all.end(), more.begin(), more.end());
        return std::move(all);
    };
    return reduce_rows<std::vector<double>>(pair.height(), of_row, append);
}

std::vector<std::optional<double>> percentiles(const ImagePair& pair) {
    std::vector<double> errors = relative_errors(pair);
    std::vector<std::optional<double>> values(std::size(kFractions));
    if (errors.empty()) return values;
    auto begin = errors.begin();  // what lies before is not greater than what follows: fractions ascend
    for (size_t i = 0; i < values.size(); ++i) {
        const double rank = kFractions[i] * static_cast<double>(errors.size() - 1);
        const auto low = errors.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(begin, low, errors.end());
        const double part = rank - std::floor(rank);
        const double next = low + 1 < errors.end() ? *std::min_element(low + 1, errors.end()) : *low;
        values[i] = *low + part * (next - *low);
        begin = low;
    }
    return values;
}

}  // namespace

extern const Metric metric_percentiles{.key = "percentiles",
                                       .summary = "percentiles of the pixels' relative errors, of linear values",
                                       .values = kValues,
                                       .measure = percentiles};

}  // namespace lightsweep
