// What each skip saved, for the terminal. From the report's JSON alone.
#pragma once

#include "bench/report/record.h"

#include <string>

namespace lightsweep {

/// A table for each scene, light count, size and path whose cells differ in skips, each after an empty line; empty when
/// none do.
std::string skip_savings_text(const Json& report);

}  // namespace lightsweep
