#include "bench/metrics/flip.h"
#include "bench/metrics/reduce.h"

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

void write_flip_map(const FlipMap& map, const std::filesystem::path& file) {
    std::vector<uint16_t> grey(map.error.size());
    std::ranges::transform(map.error, grey.begin(), [](float error) {
        const float clamped = error > 0.0F ? std::min(error, 1.0F) : 0.0F;  // NaN compares false
        return static_cast<uint16_t>(std::lround(65535.0F * clamped));
    });
    write_grey16_png(map.width, map.height, grey, file);
}

Image flip_picture(const FlipMap& map) {
    Image picture(map.width, map.height, ColorSpace::display);
    for (size_t i = 0; i < map.error.size(); ++i)
        std::ranges::copy(is_finite(map.error[i]) ? magma(map.error[i]) : kNonfiniteColor, &picture.rgb[3 * i]);
    return picture;
}

}  // namespace lightsweep
