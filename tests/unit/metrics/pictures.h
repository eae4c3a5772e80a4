// Small pictures for the tests of the metrics.
#pragma once

#include "bench/metrics/image_pair.h"
#include "renderer/base/random.h"

#include <limits>
#include <vector>

namespace lightsweep {

inline constexpr float kInf = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

inline Image image_of(int width, int height, std::vector<float> rgb, ColorSpace space = ColorSpace::linear) {
    Image image(width, height, space);
    image.rgb = std::move(rgb);
    return image;
}

/// One colour everywhere.
inline Image flat(int width, int height, float r, float g, float b, ColorSpace space) {
    Image image(width, height, space);
    for (size_t i = 0; i < image.rgb.size(); i += 3) image.rgb[i] = r, image.rgb[i + 1] = g, image.rgb[i + 2] = b;
    return image;
}

/// Uniform in [0, 1).
inline Image noise(int width, int height, uint64_t seed, ColorSpace space = ColorSpace::linear) {
    Random random(seed);
    Image image(width, height, space);
    for (float& v : image.rgb) v = static_cast<float>(random.uniform());
    return image;
}

/// (1 - part) * a + part * b
inline Image blend(const Image& a, const Image& b, float part) {
    Image image = a;
    for (size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = (1 - part) * a.rgb[i] + part * b.rgb[i];
    return image;
}

/// Multiples of 1/31 in a pattern that anyone can repeat: the expected numbers of the tests were computed from it with
/// numpy in double precision, by the definitions and with whole two-dimensional filters.
inline Image pattern(int kind, ColorSpace space) {
    Image image(29, 23, space);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] = static_cast<float>((x * 7 + y * 13 + c * 11 + kind * x * y) % 32) / 31.0F;
    return image;
}

/// Columns for rows.
inline Image transposed(const Image& image) {
    Image result(image.height, image.width, image.space);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) result.pixel(y, x)[c] = image.pixel(x, y)[c];
    return result;
}

}  // namespace lightsweep
