// The ratio of two arms that were measured side by side, and what may be said about it. Pure functions of samples.
#pragma once

#include "bench/stats/quantile.h"

#include <optional>
#include <span>
#include <string_view>

namespace lightsweep {

/// a over b. An absent end of `ratio` is 0 below and infinity above.
struct PairedRatio {
    Interval ratio;
    size_t pairs = 0;
    double effective_count = 0;  ///< pairs, less what autocorrelation takes: effective_sample_size() of their sides
};

/// exp of the median of log(a[i] / b[i]), where a[i] and b[i] are times of one round, so that what slows the whole
/// machine cancels. The interval is the percentile interval of block_median_interval(); below 20 effective pairs it is
/// that of median_interval(), which needs no approximation, and below 6 it is unbounded at 0.95. For many comparisons
/// give level_for_each(). `a` and `b` in the order taken, of equal length. Nothing when there is no pair, or when a
/// sample is not a positive finite number: such a time has no ratio.
std::optional<PairedRatio> ratio_of_pairs(std::span<const double> a, std::span<const double> b, double level = 0.95);

enum class Verdict { faster, slower, same, ambiguous };

/// The word in reports: "faster", ...
std::string_view word(Verdict verdict);

/// What `ratio` (a over b, of times) says about a. `floor` >= 0 is the smallest relative difference that this machine
/// can show (0.02: two percent, from its A/A pair): the whole interval inside [1 / (1 + floor), 1 + floor] is `same`,
/// below it `faster`, above it `slower`; an interval that lies across an edge is `ambiguous`.
Verdict verdict(const Interval& ratio, double floor);

}  // namespace lightsweep
