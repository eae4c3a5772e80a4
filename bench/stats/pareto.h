// Time against error: the arms that no other arm beats in both. A pure function.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightsweep {

struct TimeAndError {
    double time = 0;
    double error = 0;
};

/// The indices of the points that no other point dominates, by rising time, then by index. A point dominates another
/// when it is no worse in both and better in one, so points equal in both stand on the front together. A point with a
/// coordinate that is not finite is never on it.
std::vector<size_t> pareto_front(std::span<const TimeAndError> points);

}  // namespace lightsweep
