// The cost model that path=auto decides by, for commands that need one.
#pragma once

#include "bench/measure/calibrate.h"

namespace lightsweep {

/// Measures it on the current context, telling the terminal, and keeps it.
CostModel measure_costs(const Environment& environment);
/// The one kept for this machine, or measured now.
CostModel known_costs(const Environment& environment);

}  // namespace lightsweep
