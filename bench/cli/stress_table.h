// The end of a stress run on the terminal: the breakdown tables, what failed, what is beyond a format, the counts.
#pragma once

#include "bench/report/record.h"

#include <string>

namespace lightsweep {

/// From the JSON of the run alone; holds no time.
std::string stress_text(const Json& report);

/// The rows of `ulp`, function by function.
std::string ulp_text(const Json& rows);

}  // namespace lightsweep
