// How a target's format rounds what is written and blended into it. Probed, not assumed: some drivers truncate.
#pragma once

#include "bench/report/record.h"
#include "renderer/gl/format.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// Where a value goes that lies between two steps of a format.
enum class Rounding : uint8_t { nearest, truncate, other };
std::string word(Rounding rounding);

/// Where `nearest` goes from half-way between two steps.
enum class Ties : uint8_t { to_even, up, down, other };
std::string word(Ties ties);

/// Of a format's red channel. Empty: the device does not draw or blend there, or there is nothing to tell.
struct RoundingProbe {
    std::string format;                  ///< its name in small letters, as CellParams::hdr
    std::optional<Rounding> write = {};  ///< a shader's output stored
    std::optional<Ties> ties = {};       ///< of it; of floats that round to nearest, the others have no exact ties
    std::optional<Rounding> blend = {};  ///< a sum by additive blending
    std::optional<double> sum_of_tenths = {};  ///< 4000 x 0.1 blended, of HDR formats: 400 in exact arithmetic
};

/// On the current context. Integer and depth formats round in other ways: programmer's mistake.
RoundingProbe probe_rounding(gl::Format format);
/// Probes every colour format that is not of integers.
std::vector<RoundingProbe> probe_rounding();
Json to_json(const std::vector<RoundingProbe>& probes);

/// Of a floating-point channel that is stored in 32, 16, 11 or 10 bits (gl::FormatInfo::bits): what follows the leading
/// one. From 1 to 2 numbers are 2^-bits apart.
int mantissa_bits(int stored_bits);

}  // namespace lightsweep
