// From linear radiance to display values, in double precision.
#include "renderer/reference/reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr double kLargest = 65504.0;  // of a half float; the display's cap on radiance

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve".
double aces_fit(double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

// IEC 61966-2-1.
double srgb_encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

float display_value(float radiance) {
    if (std::isnan(radiance)) return 0.0F;
    const double mapped = aces_fit(std::clamp(static_cast<double>(radiance), 0.0, kLargest));
    return static_cast<float>(srgb_encoded(std::min(mapped, 1.0)));
}

}  // namespace

Image tone_mapped(const Image& linear) {
    Image display(linear.width, linear.height, ColorSpace::display);
    tbb::parallel_for(0, linear.height, [&](int y) {
        const float* row = linear.pixel(0, y);
        std::transform(row, row + size_t{3} * static_cast<size_t>(linear.width), display.pixel(0, y), display_value);
    });
    return display;
}

}  // namespace lightsweep
