#include "bench/stats/linear_fit.h"

#include "renderer/base/check.h"

#include <numeric>

namespace lightsweep {

std::optional<LinearFit> linear_fit(std::span<const double> x, std::span<const double> y) {
    CHECK_THAT(x.size() == y.size(), "{} and {} values", x.size(), y.size());
    if (x.empty()) return {};
    const auto n = static_cast<double>(x.size());
    const double mean_x = std::reduce(x.begin(), x.end()) / n;
    const double mean_y = std::reduce(y.begin(), y.end()) / n;
    double xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    if (xx == 0) return {};
    const double slope = xy / xx;
    return LinearFit{
        .slope = slope, .intercept = mean_y - slope * mean_x, .r_squared = yy == 0 ? 0 : xy * xy / (xx * yy)};
}

}  // namespace lightsweep
