// The nonnegative combination of columns that comes nearest to a target. A pure function.
#pragma once

#include <span>
#include <vector>

namespace lightsweep {

/// x >= 0 that minimises |A x - b|^2, by cyclic coordinate descent on the normal equations (Franc, Hlavac and Navara
/// 2005, "Sequential coordinate-wise algorithm for the non-negative least squares problem"). `rows` are A's, equally
/// long and finite, one for each element of `b`. Columns of zeros get 0.
std::vector<double> nonnegative_fit(std::span<const std::vector<double>> rows, std::span<const double> b);

}  // namespace lightsweep
