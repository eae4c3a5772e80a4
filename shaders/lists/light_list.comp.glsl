// Lists the lights of one cell for each thread, from the masks that light_mask left. Room is reserved for all that the
// masks name, then those that touch the cell are written. DEPTH_BOUNDS: the cell ends where its tile's surfaces do.
#include "lists/grid.glsl"

layout(local_size_x = 64) in;
layout(binding = kLightMaskUnit) uniform usamplerBuffer masks;
#ifdef DEPTH_BOUNDS
layout(binding = kTileDepthUnit) uniform sampler2D tile_depths;
#endif
layout(std430, binding = kLightCellBuffer) writeonly buffer Cells { uvec2 cells[]; };
layout(std430, binding = kLightIndexBuffer) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = kWantedBuffer) buffer Wanted {
    uint wanted, wanted_carry;  // room for all lists, a number of 64 bits
    uint lists_cut;             // a driver ended a loop before its end
};

// Of a cell; where both have bits, a light may touch it.
struct Rows {
    uint tile, slice;
};

uint common_bits(Rows rows, uint word) {
    return texelFetch(masks, int(rows.tile + word)).x & texelFetch(masks, int(rows.slice + word)).x;
}

// Which words of a group of 32 may have common bits.
uint common_words(Rows rows, uint group) { return common_bits(rows, light_grid.word_count + group); }

uint count_common(Rows rows) {
    uint count = 0u, group = 0u, words = 0u;
    for (; group < summary_words(light_grid); ++group) {
        for (words = common_words(rows, group); words != 0u; words &= words - 1u)
            count += uint(bitCount(common_bits(rows, group * 32u + uint(findLSB(words)))));
    }
    if (group < summary_words(light_grid) || words != 0u) lists_cut = 1u;
    return count;
}

// Returns where the list begins; a list that does not fit becomes empty.
uint reserve(inout uint count) {
    uint begin = atomicAdd(wanted, count);
    if (begin + count < begin) atomicAdd(wanted_carry, 1u);
    bool fits = count <= light_grid.index_capacity && begin <= light_grid.index_capacity - count;
    if (!fits) count = 0u;
    return begin;
}

// Returns where the list ends.
uint write_list(Rows rows, CellBounds cell, uint begin) {
    uint end = begin, group = 0u, words = 0u, bits = 0u;
    for (; group < summary_words(light_grid); ++group) {
        words = common_words(rows, group);
        uint word = 0u;
        while (true) {
            // The search is a loop of its own: software drivers skip loops but not branches, and a test costs more.
            while (bits == 0u && words != 0u) {
                word = group * 32u + uint(findLSB(words));
                words &= words - 1u;
                bits = common_bits(rows, word);
            }
            if (bits == 0u) break;
            uint light = word * 32u + uint(findLSB(bits));
            bits &= bits - 1u;
            if (light_touches_cell(bounds_at(light), cell)) indices[end++] = frame.directional_count + light;
        }
    }
    if (group < summary_words(light_grid) || words != 0u || bits != 0u) lists_cut = 1u;
    return end;
}

void main() {
    // Neighbours are slices of one tile: they walk the same row.
    uint tile = gl_GlobalInvocationID.x / light_grid.slices;
    uint slice = gl_GlobalInvocationID.x % light_grid.slices;
    uint tiles = light_grid.tiles_x * light_grid.tiles_y;
    if (tile >= tiles) return;
    uvec2 place = uvec2(tile % light_grid.tiles_x, tile / light_grid.tiles_x);
#ifdef DEPTH_BOUNDS
    vec2 z = texelFetch(tile_depths, ivec2(place), 0).xy;
#else
    vec2 z = vec2(slice_begin(light_grid, slice), slice_begin(light_grid, slice + 1u));
#endif
    CellBounds cell = cell_bounds(light_grid, place.x, place.y, z.x, z.y);
    Rows rows = Rows(tile * row_words(light_grid), (tiles + slice) * row_words(light_grid));

    uint room = z.x > z.y ? 0u : count_common(rows);
    uint begin = reserve(room);
    uint end = room == 0u ? begin : write_list(rows, cell, begin);
    cells[slice * tiles + tile] = uvec2(begin, end - begin);
}
