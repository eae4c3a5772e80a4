// What a floating-point format makes of a number, and of many that are added up in it: the law beside which blended
// sums are held. Pure arithmetic; knows no GL.
#pragma once

#include "bench/measure/rounding_probe.h"
#include "renderer/gl/format.h"

#include <span>

namespace lightsweep {

/// A channel of a floating-point format (OpenGL 4.5, 2.3.4).
struct FloatChannel {
    int mantissa_bits = 23;  ///< after the leading one
    double smallest_normal = 0x1p-126;
    double largest = 0x1.fffffep+127;
    bool has_sign = true;

    /// From 1 to the next number: the most that truncating takes from a number, relative to it.
    double epsilon() const;
};

/// Of the channel with the fewest bits among red, green and blue: R11G11B10F keeps one bit less of blue.
FloatChannel coarsest_channel(gl::Format format);
/// Its index: 0 red, 1 green, 2 blue.
int coarsest_channel_index(gl::Format format);

/// `value` with `mantissa_bits` after its leading one; `nearest` takes ties to even. The exponent has no ends.
/// `rounding`: not `other`.
double rounded(double value, int mantissa_bits, Rounding rounding);

/// 0 and then each of `values` added in turn, each sum rounded before the next: N lights blended into a target.
double rounded_sum(std::span<const double> values, int mantissa_bits, Rounding rounding);

}  // namespace lightsweep
