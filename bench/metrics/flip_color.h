// The colour spaces of FLIP, whole rows at a time. All branches are choices between values, so that every loop becomes
// vector code.
#pragma once

#include "bench/metrics/vector_math.h"

#include <array>
#include <cmath>

namespace lightsweep::flip_color {

/// Linear sRGB to CIE XYZ under D65, and back, with the digits of the authors' own implementation.
inline constexpr double kRgbToXyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                           {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                           {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
inline constexpr double kXyzToRgb[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                           {-0.969224334, 1.875930071, 0.041554224},
                                           {0.055639423, -0.204011202, 1.057148933}};
inline constexpr double kWhite[3] = {0.950428545, 1.0, 1.088900371};

using Matrix = std::array<std::array<float, 3>, 3>;

/// Linear sRGB to XYZ as fractions of white.
inline constexpr Matrix kToRelativeXyz = [] {
    Matrix m{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) m[i][j] = static_cast<float>(kRgbToXyz[i][j] / kWhite[i]);
    return m;
}();

/// Linear sRGB to opponent colours: Y, X - Y and Y - Z as fractions of white. This is the paper's YCxCz without its
/// scales and offset, which the filters would only carry along.
inline constexpr Matrix kToOpponent = [] {
    Matrix m{};
    for (size_t j = 0; j < 3; ++j) {
        const double x = kRgbToXyz[0][j] / kWhite[0], y = kRgbToXyz[1][j] / kWhite[1], z = kRgbToXyz[2][j] / kWhite[2];
        m[0][j] = static_cast<float>(y);
        m[1][j] = static_cast<float>(x - y);
        m[2][j] = static_cast<float>(y - z);
    }
    return m;
}();

inline constexpr Matrix kFromOpponent = [] {
    Matrix m{};
    for (size_t i = 0; i < 3; ++i) {
        const double x = kXyzToRgb[i][0] * kWhite[0], y = kXyzToRgb[i][1] * kWhite[1], z = kXyzToRgb[i][2] * kWhite[2];
        m[i] = {static_cast<float>(x + y + z), static_cast<float>(x), static_cast<float>(-z)};
    }
    return m;
}();

inline float dot(const std::array<float, 3>& m, float a, float b, float c) { return m[0] * a + m[1] * b + m[2] * c; }

/// Clamped to [0, 1]; -0 and NaN become 0.
inline float unit(float v) {
    const float positive = choose(v > 0.0F, v, 0.0F);
    return choose(positive < 1.0F, positive, 1.0F);
}

/// Linear sRGB, in place.
inline void to_opponent(float* __restrict r, float* __restrict g, float* __restrict b, int count) {
    for (int i = 0; i < count; ++i) {
        const float red = r[i], green = g[i], blue = b[i];
        r[i] = dot(kToOpponent[0], red, green, blue);
        g[i] = dot(kToOpponent[1], red, green, blue);
        b[i] = dot(kToOpponent[2], red, green, blue);
    }
}

/// CIELAB's f, of a fraction of white.
inline float lab_curve(float t) {
    constexpr float kDelta = 6.0F / 29.0F;
    const float root = vector_pow(t, 1.0F / 3.0F);
    const float line = t * (1.0F / (3 * kDelta * kDelta)) + 4.0F / 29.0F;
    return choose(t > kDelta * kDelta * kDelta, root, line);
}

/// Opponent colours to CIELAB, clamped to the colours of sRGB, with the Hunt effect: chroma weighs less where it is
/// dark. In place.
inline void to_hunt_lab(float* __restrict a, float* __restrict b, float* __restrict c, int count) {
    for (int i = 0; i < count; ++i) {
        const float red = unit(dot(kFromOpponent[0], a[i], b[i], c[i]));
        const float green = unit(dot(kFromOpponent[1], a[i], b[i], c[i]));
        const float blue = unit(dot(kFromOpponent[2], a[i], b[i], c[i]));
        const float x = lab_curve(dot(kToRelativeXyz[0], red, green, blue));
        const float y = lab_curve(dot(kToRelativeXyz[1], red, green, blue));
        const float z = lab_curve(dot(kToRelativeXyz[2], red, green, blue));
        const float lightness = 116 * y - 16;
        a[i] = lightness;
        b[i] = 0.01F * lightness * 500 * (x - y);
        c[i] = 0.01F * lightness * 200 * (y - z);
    }
}

}  // namespace lightsweep::flip_color
