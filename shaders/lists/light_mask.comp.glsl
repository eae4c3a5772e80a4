// Sets each light's bit in the rows of the tiles and of the slices that its sphere may touch (shared/light_masks.h): all
// that light_touches_cell accepts, and few more. The bits order the lists: no sorting, and the same lists every time.
#include "lists/grid.glsl"

layout(local_size_x = 128) in;
layout(location = kLaneBitsUniform) uniform uint lane_bits;
layout(std430, binding = kLightMaskBuffer) buffer Masks { uint masks[]; };

// Rounding moves a sphere's edge by less than this; a tile more is a test more.
const float kMarginPx = 0.5;
const float kMarginSlices = 0.01;

// First and last tile along one axis; first > last: none.
ivec2 touched_tiles(float across, float z, float radius, float tangent_per_px, float tan_edge, uint tiles) {
    vec2 slopes = disc_slopes(across, z, radius * radius, 0.0, z + radius);
    vec2 px = (slopes + tan_edge) / tangent_per_px + vec2(-kMarginPx, kMarginPx);
    ivec2 touched = ivec2(floor(clamp(px / float(light_grid.tile_px), -1.0, float(tiles))));
    return ivec2(max(touched.x, 0), min(touched.y, int(tiles) - 1));
}

ivec2 touched_slices(vec2 z) {
    vec2 position = log2(max(z, 1e-20)) * light_grid.slice_scale + light_grid.slice_offset;
    vec2 last = vec2(light_grid.slices - 1u);
    return ivec2(floor(clamp(position + vec2(-kMarginSlices, kMarginSlices), vec2(0.0), last)));
}

void set_bit(uint row, uint light) {
    uint begin = row * row_words(light_grid);
    atomicOr(masks[begin + light / 32u], 1u << (light % 32u));
    atomicOr(masks[begin + light_grid.word_count + light / 1024u], 1u << (light / 32u % 32u));
}

void main() {
    uint light = gl_GlobalInvocationID.x >> lane_bits;
    if (light >= bounds_count()) return;
    int lanes = 1 << lane_bits;
    int lane = int(gl_GlobalInvocationID.x) & (lanes - 1);
    vec4 sphere = bounding_sphere(light);
    ivec2 x = touched_tiles(sphere.x, sphere.z, sphere.w, light_grid.tangent_per_px_x, light_grid.tan_x,
                            light_grid.tiles_x);
    ivec2 y = touched_tiles(sphere.y, sphere.z, sphere.w, light_grid.tangent_per_px_y, light_grid.tan_y,
                            light_grid.tiles_y);
    for (int row = y.x + lane; row <= y.y; row += lanes) {
        for (int column = x.x; column <= x.y; ++column) set_bit(uint(row) * light_grid.tiles_x + uint(column), light);
    }
    ivec2 slices = touched_slices(sphere.z + vec2(-sphere.w, sphere.w));
    for (int slice = slices.x + lane; slice <= slices.y; slice += lanes) {
        set_bit(light_grid.tiles_x * light_grid.tiles_y + uint(slice), light);
    }
}
