// The table of stress cases, in the order of their numbers.
#pragma once

#include "bench/stress/case.h"

#include <span>
#include <string_view>

namespace lightsweep {

std::span<const StressCase* const> all_stress_cases();

/// Throws InputError naming the nearest id.
const StressCase& find_stress_case(std::string_view id);

}  // namespace lightsweep
