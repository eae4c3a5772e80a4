// The light count at which two paths cost the same. Pure functions of ratios.
#pragma once

#include "bench/stats/quantile.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lightsweep {

struct Crossover {
    /// The light count where the ratio passes 1; an absent end: it may lie beyond what was measured. Nothing when the
    /// two do not change places, or when that cannot be told from noise.
    std::optional<Interval> lights;
    /// One sentence in the arms' names: who is faster where, or why there is no crossing.
    std::string statement;
};

/// `ratios[i]` is a over b (times) with its interval at `lights[i]` lights, which rise strictly from 0 or more.
///
/// Between the measured counts the logarithm of the ratio runs straight over log2(lights), or over log2(1 + lights)
/// when 0 lights were measured. The interval is the stretch around the crossing where the ratio's own interval holds 1,
/// that is, between the crossings of its low and its high curve. An odd number of changes counts as one, at the middle
/// one.
Crossover find_crossover(std::span<const double> lights, std::span<const Interval> ratios, std::string_view a,
                         std::string_view b);

}  // namespace lightsweep
