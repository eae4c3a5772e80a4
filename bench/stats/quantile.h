// Order statistics: median, quantiles, and the interval of a median. Pure functions of samples; knows no units.
#pragma once

#include <optional>
#include <span>

namespace lightsweep {

/// An estimate and the interval that holds the truth with the level asked for. An end that the samples cannot bound at
/// that level is absent: the interval reaches to infinity there.
struct Interval {
    double estimate = 0;
    std::optional<double> low, high;
};

/// Linear interpolation between order statistics: type 7 of Hyndman and Fan, "Sample Quantiles in Statistical
/// Packages", The American Statistician 50, 1996. `fraction` in [0, 1]; at least one sample, none NaN.
double quantile(std::span<const double> samples, double fraction);

/// quantile(samples, 0.5)
double median(std::span<const double> samples);

/// The median and its distribution-free interval from order statistics (the inverted sign test; Conover, "Practical
/// Nonparametric Statistics", 3.2). For autocorrelated samples the ranks are spread as if there were only
/// effective_sample_size() of them, taken on which side of the median each sample lies: that is what a sample says
/// about the median. Holds with at least `level` for independent samples; needs 6 effective samples for two ends at
/// 0.95. `samples` in the order taken, at least one, none NaN; 0 < level < 1.
Interval median_interval(std::span<const double> samples, double level = 0.95);

/// Bonferroni's correction: the level for each of `comparisons` intervals such that all of them hold together with
/// `level`.
double level_for_each(double level, size_t comparisons);

}  // namespace lightsweep
