// How much a sample says about the next one: frame times are not independent. Pure functions of samples.
#pragma once

#include <span>
#include <vector>

namespace lightsweep {

/// The number of independent samples that would fix the mean as well as these do, in [1, n]: n over the integrated
/// autocorrelation time, summed by the initial positive sequence estimator (Geyer, "Practical Markov Chain Monte
/// Carlo", Statistical Science 7, 1992, section 3.3): pairs of neighbouring lags, as long as their sum is positive.
/// Negative correlation is not counted as a gain. Samples all equal count in full, and so do
/// fewer than ten, from which no autocorrelation can be told.
/// `samples` in the order taken, at least one, all finite.
double effective_sample_size(std::span<const double> samples);

/// Where each sample lies: -1 below the median, 0 on it, +1 above. What a sample contributes to a median in the first
/// order, so that its autocorrelation, and not that of the values, governs the median's error.
std::vector<double> sides_of_median(std::span<const double> samples);

}  // namespace lightsweep
