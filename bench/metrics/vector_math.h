// Powers of floats by arithmetic alone: no calls, no branches, no table, so that a loop over pixels becomes vector code
// and gives the same bits on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace lightsweep {

/// `yes ? a : b`. By bits, since a choice between floats may become a branch around the work for one of them, and then
/// the loop stays scalar.
inline float choose(bool yes, float a, float b) {
    const int32_t mask = -static_cast<int32_t>(yes);
    return std::bit_cast<float>((std::bit_cast<int32_t>(a) & mask) | (std::bit_cast<int32_t>(b) & ~mask));
}

/// Of a normal positive float, within 1 ulp of max(|result|, 1). atanh's series: ln m = 2 (s + s^3/3 + ...),
/// s = (m - 1) / (m + 1), with m in [sqrt(1/2), sqrt(2)): |s| < 0.172.
inline float vector_log2(float x) {
    constexpr float kScale = 2.8853900817779268F;  // 2 / ln 2
    const auto bits = std::bit_cast<int32_t>(x);
    const int32_t exponent = (bits - std::bit_cast<int32_t>(0.70710678F)) >> 23;
    const float m = std::bit_cast<float>(bits - (exponent << 23));
    const float s = (m - 1.0F) / (m + 1.0F);
    const float q = s * s;
    const float series = q * (1.0F / 3 + q * (1.0F / 5 + q * (1.0F / 7 + q * (1.0F / 9))));
    return static_cast<float>(exponent) + kScale * (s + s * series);
}

/// `x` in [-126, 127]; relative error below 3e-7. The exponential's series on [-ln 2 / 2, ln 2 / 2].
inline float vector_exp2(float x) {
    constexpr float kRound = 12582912.0F;  // 1.5 * 2^23: adding it leaves the nearest integer in the low bits
    const float shifted = x + kRound;
    const float f = (x - (shifted - kRound)) * 0.69314718F;
    const float series =
        1 + f * (1 + f * (1.0F / 2 + f * (1.0F / 6 + f * (1.0F / 24 + f * (1.0F / 120 + f * (1.0F / 720))))));
    const auto whole = std::bit_cast<int32_t>(shifted) - std::bit_cast<int32_t>(kRound);
    return std::bit_cast<float>(std::bit_cast<int32_t>(series) + (whole << 23));
}

/// x^p for x in [1e-37, 1e37] with a result in [1e-37, 1e37]: relative error below 1.1e-7 * (2 + p * |log2 x|). And for
/// x = +0 with p in [0, 1]: exactly 0.
inline float vector_pow(float x, float p) {
    const auto bits = std::bit_cast<int32_t>(x);
    constexpr auto kTiny = std::bit_cast<int32_t>(1e-37F);
    const float power = vector_exp2(p * vector_log2(std::bit_cast<float>(bits > kTiny ? bits : kTiny)));
    return choose(bits > 0, power, 0.0F);
}

}  // namespace lightsweep
