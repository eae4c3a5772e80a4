#include "bench/metrics/error_map.h"

#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lightsweep {
namespace {

constexpr std::array<float, 3> kNonfiniteColor = {0.0F, 1.0F, 0.0F};

/// matplotlib's magma (van der Walt and Smith, 2015; CC0) within 0.02, by the polynomials of Matt Zucker
/// (https://www.shadertoy.com/view/WlfXRN, CC0). `t` in [0, 1].
std::array<float, 3> magma(double t) {
    constexpr double kCoefficients[7][3] = {
        {-0.002136485053939582, -0.000749655052795221, -0.005386127855323933},
        {0.2516605407371642, 0.6775232436837668, 2.494026599312351},
        {8.353717279216625, -3.577719514958484, 0.3144679030132573},
        {-27.66873308576866, 14.26473078096533, -13.64921318813922},
        {52.17613981234068, -27.94360607168351, 12.94416944238394},
        {-50.76852536473588, 29.04658282127291, 4.23415299384598},
        {18.65570506591883, -11.48977351997711, -5.601961508734096},
    };
    std::array<float, 3> color{};
    for (size_t c = 0; c < 3; ++c) {
        double value = 0;
        for (size_t k = 7; k-- > 0;) value = value * t + kCoefficients[k][c];
        color[c] = static_cast<float>(std::clamp(value, 0.0, 1.0));
    }
    return color;
}

}  // namespace

Image error_map(const Image& reference, const Image& test) {
    require_comparable(reference, test);
    const auto difference = [](double r, double v) { return std::abs(v - r); };
    const double most = reduce_finite(reference, test, difference, kMax).value;
    constexpr double kDecades = 4;
    Image map(reference.width, reference.height, ColorSpace::display);
    tbb::parallel_for(0, map.height, [&](int y) {
        for (int x = 0; x < map.width; ++x) {
            const float* r = reference.pixel(x, y);
            const float* v = test.pixel(x, y);
            std::array<float, 3> color = kNonfiniteColor;
            if (all_finite({r, 3}) && all_finite({v, 3})) {
                double error = 0;
                for (int c = 0; c < 3; ++c) error = std::max(error, difference(r[c], v[c]));
                color = magma(error > 0 ? std::max(0.0, 1 + std::log10(error / most) / kDecades) : 0.0);
            }
            std::ranges::copy(color, map.pixel(x, y));
        }
    });
    return map;
}

}  // namespace lightsweep
