// Random scenes and cells, extreme on purpose, from a seed alone: scales, origins, slivers, materials, cameras inside
// of things, lights of all sizes and none. Knows the scene format (scenes/README.md), no GL.
#pragma once

#include "bench/plan/cell.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <vector>

namespace lightsweep {

struct FuzzCase {
    uint64_t seed = 0;
    nlohmann::ordered_json scene;  ///< the content of a scene file
    std::vector<CellParams>
        cells;  ///< of this scene (`scene` is empty), all of one size and light count, layout as used
};

/// Some cells of a random scene: paths, one layout, HDR format, skips, who lists lights. Pictures of 1 to 96 px a side.
FuzzCase make_fuzz_case(uint64_t seed);

}  // namespace lightsweep
