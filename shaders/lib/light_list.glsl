// The lights listed for a pixel's cell of the grid (renderer/frame/light_list_service.h).
#include "shared/slots.h"
#include "shared/types.h"
#include "shared/light_cell.h"

layout(std140, binding = kLightGridBlock) uniform LightGridBlock { LightGridData light_grid; };
layout(binding = kLightCellUnit) uniform usamplerBuffer light_cells;
layout(binding = kLightIndexUnit) uniform usamplerBuffer light_indices;

struct LightList {
    uint begin, end;  // positions for listed_light
};

// Of the pixel centre `frag_coord`, whose surface is at the view distance `z`.
LightList light_list(vec2 frag_coord, float z) {
    uvec2 tile = uvec2(frag_coord) / light_grid.tile_px;
    uint cell = (slice_of(light_grid, z) * light_grid.tiles_y + tile.y) * light_grid.tiles_x + tile.x;
    uvec2 list = texelFetch(light_cells, int(cell)).xy;
    return LightList(list.x, list.x + list.y);
}

// Index for light_at.
uint listed_light(uint position) { return texelFetch(light_indices, int(position)).x; }
