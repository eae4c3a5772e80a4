// A picture against exact radiance with a bound for each pixel. Pure functions; know no GL.
#pragma once

#include "bench/stress/fuzz_bounds.h"
#include "renderer/image/image.h"

#include <string>
#include <vector>

namespace lightsweep {

/// What a format of the HDR target (CellParams::hdr) does to a value: rounds it by `relative` of it and by `step`,
/// whole steps since some drivers truncate (and flush r11g11b10f's denormals), and ends at `largest`. Of its coarsest
/// channel.
struct HdrRounding {
    double relative = 0.0, step = 0.0, largest = 0.0;
};
HdrRounding hdr_rounding(const std::string& hdr);

/// Relative to a pixel's largest channel: a light's some hundred operations round by some 10^-5, and this is ten times
/// that.
inline constexpr double kArithmetic = 1e-4;
/// Each movement stands for a few roundings of its kind, not for their worst case.
inline constexpr double kExplained = 2.0;

struct PictureFaults {
    size_t judged = 0;  ///< pixels
    size_t wrong = 0;   ///< of those, beyond the bound
    size_t non_finite = 0;
    size_t saturated = 0;        ///< pixels past the format's largest value, which show that or infinity
    double largest_exact = 0.0;  ///< of those
    std::string worst;           ///< of those that are wrong: where, what it should be, what it is

    bool any() const { return wrong > 0 || non_finite > 0; }
};

/// `judged`: the pixels whose exact value is known; others must be finite all the same. `may_saturate`: those that pass
/// what the format holds on the way, though not at the end; empty for none. `roundings`: how many times a sum is
/// stored.
PictureFaults find_faults(const Image& image, const BoundedRadiance& exact, const std::vector<bool>& judged,
                          const std::vector<bool>& may_saturate, const HdrRounding& hdr, int roundings);

/// The q-quantile of |image - exact| / |exact| over judged pixels brighter than `darkest`; 0 where there are none.
double relative_error_quantile(const Image& image, std::span<const glm::dvec3> exact, const std::vector<bool>& judged,
                               double darkest, double q);

}  // namespace lightsweep
