// Where the compute builder keeps which lights may touch a tile or a slice: rows of bits, first one for each tile, then
// one for each slice. A light may touch a cell when both rows of the cell say so. A row ends with its summary: one bit
// for each word of the row, set when that word is not 0. GLSL includes shared/types.h before.
#ifdef __cplusplus
#pragma once
#include <shaders/shared/types.h>
namespace lightsweep::shared {
#define LIGHTSWEEP_INLINE inline
#else
#define LIGHTSWEEP_INLINE
#endif

LIGHTSWEEP_INLINE uint summary_words(LightGridData grid) { return (grid.word_count + 31U) / 32U; }

LIGHTSWEEP_INLINE uint row_words(LightGridData grid) { return grid.word_count + summary_words(grid); }

LIGHTSWEEP_INLINE uint row_count(LightGridData grid) { return grid.tiles_x * grid.tiles_y + grid.slices; }

#ifdef __cplusplus
}  // namespace lightsweep::shared
#endif
#undef LIGHTSWEEP_INLINE
