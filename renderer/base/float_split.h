// A double as the sum of two floats, for shaders that have no doubles.
#pragma once

#include <bit>
#include <cstdint>

namespace lightsweep {

/// What the double `v` becomes as a 32-bit float (to nearest, ties to even), as a double: for the normal range of
/// floats. By its bits, not by converting to float and back: GCC 12 vectorises pairs of that from -O2 on, and folds it
/// to no conversion at all, so that nothing is left of v - rounded_to_float(v).
inline double rounded_to_float(double v) {
    constexpr int kDropped = 52 - 23;
    constexpr uint64_t kBelowHalf = (uint64_t{1} << (kDropped - 1)) - 1;
    const uint64_t bits = std::bit_cast<uint64_t>(v);
    const uint64_t odd = bits >> kDropped & 1U;
    return std::bit_cast<double>((bits + kBelowHalf + odd) >> kDropped << kDropped);
}

/// What is left of `v` beside its float: small enough to keep 24 bits of its own, 48 together.
inline double beyond_float(double v) { return v - rounded_to_float(v); }

}  // namespace lightsweep
