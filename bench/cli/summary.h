// The end of a run on the terminal: the table of cells, the crossovers, what skips saved, what was not measured, the
// answers.
#pragma once

#include "bench/report/record.h"

#include <string>

namespace lightsweep {

/// From the report's JSON alone.
std::string summary_text(const Json& report);

/// The answers to --max-error and --max-time, group by group, each after an empty line; empty when nothing was asked.
std::string answers_text(const Json& report);

}  // namespace lightsweep
