// Contrast sensitivity: section 4.1.1 and table 1 of the FLIP paper; each channel's is a Gaussian or a sum of two, over
// cycles per degree, and so over degrees. Feature detection: section 4.2.
#include "bench/metrics/flip_filters.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

using std::numbers::pi;

/// The middle weight and those to its right.
using Half = std::vector<double>;

/// a sqrt(pi / b) exp(-(pi x)^2 / b), x in degrees.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047};
constexpr Sensitivity kRedGreen{1.0, 0.0053};
constexpr Sensitivity kWideBlueYellow{34.1, 0.04};  // the widest of all
constexpr Sensitivity kNarrowBlueYellow{13.5, 0.025};

constexpr double kFeatureDegrees = 0.082;  // w

double sum(const Half& half) {
    double both_sides = 0;
    for (size_t k = 1; k < half.size(); ++k) both_sides += 2 * half[k];
    return half[0] + both_sides;
}

/// Without the tails, which are below a float's resolution beside the rest.
RowFilter<float> rounded(const Half& half, double scale, FilterKind kind = FilterKind::even) {
    double largest = 0;
    for (const double weight : half) largest = std::max(largest, std::abs(weight));
    size_t count = half.size();
    while (count > 1 && std::abs(half[count - 1]) < 1e-9 * largest) --count;
    RowFilter<float> filter{.weights = {}, .kind = kind};
    for (size_t k = 0; k < count; ++k) filter.weights.push_back(static_cast<float>(half[k] * scale));
    return filter;
}

}  // namespace

FlipFilters flip_filters(double pixels_per_degree) {
    CHECK_THAT(pixels_per_degree >= 1, "{} pixels per degree", pixels_per_degree);
    FlipFilters filters;

    const double deviation = std::sqrt(kWideBlueYellow.b / (2 * pi * pi)) * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    // The product of two of these, one along each axis, has the amplitude of the definition.
    const auto along_axis = [&](const Sensitivity& s) {
        Half half;
        for (int k = 0; k <= radius; ++k) {
            const double x = k / pixels_per_degree;
            half.push_back(std::sqrt(s.a * std::sqrt(pi / s.b)) * std::exp(-pi * pi * x * x / s.b));
        }
        return half;
    };
    const Half achromatic = along_axis(kAchromatic), red_green = along_axis(kRedGreen);
    filters.achromatic = rounded(achromatic, 1 / sum(achromatic));
    filters.red_green = rounded(red_green, 1 / sum(red_green));
    // Over the plane each sums to the square of its sum along an axis, and both together to 1.
    const Half wide = along_axis(kWideBlueYellow), narrow = along_axis(kNarrowBlueYellow);
    const double scale = 1 / std::hypot(sum(wide), sum(narrow));
    filters.wide_blue_yellow = rounded(wide, scale);
    filters.narrow_blue_yellow = rounded(narrow, scale);

    const double feature_deviation = 0.5 * kFeatureDegrees * pixels_per_degree;
    const int feature_radius = static_cast<int>(std::ceil(3 * feature_deviation));
    Half gaussian, first, second;  // a Gaussian and its derivatives
    double positive = 0, negative = 0;
    for (int k = 0; k <= feature_radius; ++k) {
        const double x = k / feature_deviation;
        const double g = std::exp(-x * x / 2);
        gaussian.push_back(g);
        first.push_back(x * g);
        second.push_back((x * x - 1) * g);
        (x > 1 ? positive : negative) += std::abs(second.back()) * (k == 0 ? 1 : 2);
    }
    // Positive weights sum to 1, negative ones to -1; in the odd filter those are its two sides.
    for (double& weight : second) weight /= weight > 0 ? positive : negative;
    filters.gaussian = rounded(gaussian, 1 / sum(gaussian));
    filters.edge = rounded(first, 2 / sum(first), FilterKind::odd);
    filters.point = rounded(second, 1, FilterKind::zero_sum);
    filters.radius = std::max(radius, feature_radius);
    return filters;
}

}  // namespace lightsweep
