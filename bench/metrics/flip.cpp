// The ways to show a picture (LDR-FLIP: as stored; HDR-FLIP: through a tone curve, at several exposures), of which
// flip_map() finds the error, and the numbers that the table has of it.
#include "bench/metrics/flip.h"

#include "bench/metrics/flip_color.h"
#include "bench/metrics/flip_map.h"
#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"
#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

using flip_color::unit;

/// IEC 61966-2-1.
void show_display_values(std::span<float> values) {
    for (float& v : values) {
        const float encoded = unit(v);
        const float curve = vector_pow((encoded + 0.055F) * (1.0F / 1.055F), 2.4F);
        v = choose(encoded > 0.04045F, curve, encoded * (1.0F / 12.92F));
    }
}

/// Narkowicz' fit to the ACES curve, with the exposure of 0.6 that he leaves to the caller:
/// (k[0] x^2 + k[1] x) / (k[2] x^2 + k[3] x + k[4]), as the HDR-FLIP paper has it.
constexpr float kToneCurve[5] = {0.6F * 0.6F * 2.51F, 0.6F * 0.03F, 0.6F * 0.6F * 2.43F, 0.6F * 0.59F, 0.14F};

void show_exposed(std::span<float> values, float scale) {
    constexpr float kBeyondWhite = 1e6F;  // where the squares are still finite
    for (float& v : values) {
        const float exposed = v * scale;
        const float x =
            choose(exposed < kBeyondWhite, choose(exposed > -kBeyondWhite, exposed, -kBeyondWhite), kBeyondWhite);
        v = unit((x * x * kToneCurve[0] + x * kToneCurve[1]) /
                 (x * x * kToneCurve[2] + x * kToneCurve[3] + kToneCurve[4]));
    }
}

/// The radiance that the tone curve shows as `t`.
double tone_curve_inverse(double t) {
    const double a = kToneCurve[0] - t * kToneCurve[2];
    const double b = kToneCurve[1] - t * kToneCurve[3];
    const double c = -t * kToneCurve[4];
    const double half = -0.5 * b / a;
    return half + std::sqrt(half * half - c / a);
}

/// Section 3 of the HDR-FLIP paper: from where the brightest pixel of the reference is shown as 0.85 to where the
/// median one is. Where the median is black the median of what is not black stands for it, since no exposure brightens
/// black.
FlipExposures exposures_of(const Image& reference) {
    constexpr double kShown = 0.85;
    std::vector<double> luminances;
    for (size_t i = 0; i < reference.rgb.size(); i += 3) {
        const float* v = &reference.rgb[i];
        if (all_finite({v, 3})) luminances.push_back(0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]);
    }
    const auto median = [&] {
        const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
        std::ranges::nth_element(luminances, middle);
        return *middle;
    };
    double middle = luminances.empty() ? 0 : median();
    if (!(middle > 0)) {
        std::erase_if(luminances, [](double y) { return !(y > 0); });
        if (luminances.empty()) return {.start = 0, .stop = 0, .count = 1};
        middle = median();
    }
    const double white = tone_curve_inverse(kShown);
    FlipExposures exposures{.start = std::log2(white / std::ranges::max(luminances)),
                            .stop = std::log2(white / middle)};
    exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
    return exposures;
}

}  // namespace

FlipMap ldr_flip(const Image& reference_display, const Image& test_display, double pixels_per_degree) {
    CHECK(reference_display.space == ColorSpace::display && test_display.space == ColorSpace::display);
    const Show shows[] = {show_display_values};
    return flip_map(reference_display, test_display, shows, pixels_per_degree);
}

FlipMap hdr_flip(const Image& reference_linear, const Image& test_linear, double pixels_per_degree) {
    CHECK(reference_linear.space == ColorSpace::linear && test_linear.space == ColorSpace::linear);
    const FlipExposures exposures = exposures_of(reference_linear);
    std::vector<Show> shows;
    for (int i = 0; i < exposures.count; ++i) {
        const double step = (exposures.stop - exposures.start) / std::max(1, exposures.count - 1);
        const auto scale = static_cast<float>(std::exp2(exposures.start + i * step));
        shows.push_back([scale](std::span<float> values) { show_exposed(values, scale); });
    }
    FlipMap map = flip_map(reference_linear, test_linear, shows, pixels_per_degree);
    map.exposures = exposures;
    return map;
}

FlipMap flip(const ImagePair& pair, double pixels_per_degree) {
    return pair.hdr ? hdr_flip(pair.reference_linear, pair.test_linear, pixels_per_degree)
                    : ldr_flip(pair.reference_display, pair.test_display, pixels_per_degree);
}

namespace {

std::vector<std::optional<double>> measure_flip(const ImagePair& pair) {
    const FlipMap map = flip(pair);
    double sum = 0, most = 0;
    size_t count = 0;
    for (const float error : map.error) {
        if (!is_finite(error)) continue;
        sum += error;
        most = std::max<double>(most, error);
        ++count;
    }
    std::vector<std::optional<double>> values(5);
    if (count > 0) values[0] = sum / static_cast<double>(count), values[1] = most;
    if (pair.hdr) {
        values[2] = map.exposures.start;
        values[3] = map.exposures.stop;
        values[4] = map.exposures.count;
    }
    return values;
}

constexpr std::string_view kValues[] = {"flip_mean", "flip_max", "flip_exposure_start", "flip_exposure_stop",
                                        "flip_exposure_count"};

}  // namespace

extern const Metric metric_flip{.key = "flip",
                                .summary = "the difference seen when flipping between the images (FLIP, HDR-FLIP)",
                                .values = kValues,
                                .measure = measure_flip};

}  // namespace lightsweep
