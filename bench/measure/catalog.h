// The names that a plan may use: this program's paths, with the layouts and scenes in its folders.
#pragma once

#include "bench/plan/axes.h"

namespace lightsweep {

Catalog program_catalog();

}  // namespace lightsweep
