// The straight line through points, and how straight they are. A pure function.
#pragma once

#include <optional>
#include <span>

namespace lightsweep {

struct LinearFit {
    double slope = 0;
    double intercept = 0;
    /// The share of y's variance that the line explains, in [0, 1]. 0 when y is constant: a clock that always says the
    /// same is not proportional to the work.
    double r_squared = 0;
};

/// Ordinary least squares. Nothing when x has fewer than two distinct values. Equal lengths, all finite.
std::optional<LinearFit> linear_fit(std::span<const double> x, std::span<const double> y);

}  // namespace lightsweep
