#include "bench/stress/rounding_law.h"

#include "renderer/base/check.h"

#include <cmath>

namespace lightsweep {

double FloatChannel::epsilon() const { return std::ldexp(1.0, -mantissa_bits); }

int coarsest_channel_index(gl::Format format) { return gl::info(format).components >= 3 ? 2 : 0; }

FloatChannel coarsest_channel(gl::Format format) {
    const auto& info = gl::info(format);
    CHECK_THAT(info.kind == gl::FormatKind::floating, "{}", info.name);
    const int bits = info.bits[coarsest_channel_index(format)];
    if (bits == 32) return {};
    // All shorter floats have 5 bits of exponent: from 2^-14 to what is below 2^16.
    FloatChannel channel{.mantissa_bits = mantissa_bits(bits), .smallest_normal = 0x1p-14, .has_sign = bits == 16};
    channel.largest = (2.0 - channel.epsilon()) * 0x1p15;
    return channel;
}

double rounded(double value, int mantissa_bits, Rounding rounding) {
    CHECK(rounding != Rounding::other);
    int exponent = 0;
    const double scaled = std::ldexp(std::frexp(value, &exponent), mantissa_bits + 1);
    // nearbyint: to even, in the mode that programs start in.
    return std::ldexp(rounding == Rounding::nearest ? std::nearbyint(scaled) : std::trunc(scaled),
                      exponent - mantissa_bits - 1);
}

double rounded_sum(std::span<const double> values, int mantissa_bits, Rounding rounding) {
    double sum = 0.0;
    for (const double value : values) sum = rounded(sum + value, mantissa_bits, rounding);
    return sum;
}

}  // namespace lightsweep
