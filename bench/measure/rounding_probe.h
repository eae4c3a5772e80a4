// How a target's format rounds what is written and blended into it. Probed, not assumed: some drivers truncate.
#pragma once

#include <string>
#include <vector>

namespace lightsweep {

enum class Rounding { nearest, truncate, other };
std::string word(Rounding rounding);

struct RoundingProbe {
    std::string format;         ///< as CellParams::hdr
    Rounding write;             ///< a shader's output stored
    Rounding blend;             ///< a sum by additive blending
    double sum_of_4000_tenths;  ///< 4000 x 0.1 blended: 400 in exact arithmetic
};

/// Probes every HDR format on the current context.
std::vector<RoundingProbe> probe_rounding();

}  // namespace lightsweep
