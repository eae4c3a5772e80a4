// The end of a run on the terminal: the table of cells, the crossovers, what was left out.
#pragma once

#include "bench/report/record.h"

#include <string>

namespace lightsweep {

/// From the report's JSON alone.
std::string summary_text(const Json& report);

}  // namespace lightsweep
