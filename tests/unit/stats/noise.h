// Seeded noise for the tests of statistics.
#pragma once

#include "renderer/base/random.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace lightsweep {

/// A standard normal number (Box and Muller, 1958).
inline double gaussian(Random& random) {
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

/// A stationary first-order autoregression with mean and median 0: x[i] = rho x[i - 1] + noise.
inline std::vector<double> autoregression(size_t count, double rho, uint64_t seed) {
    Random random(seed);
    std::vector<double> samples(count);
    double state = gaussian(random) / std::sqrt(1 - rho * rho);
    for (double& v : samples) v = state = rho * state + gaussian(random);
    return samples;
}

}  // namespace lightsweep
