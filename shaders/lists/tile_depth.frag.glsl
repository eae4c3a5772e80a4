// The lowest and highest view distance of the surfaces under each tile, one fragment for each; low > high: no surface.
// TILE_PX: the edge of a tile, even. DEPTH_STEP: how far a stored depth may be off; a position that the G-buffer stores
// is not rounded with it. WITH_BACKGROUND: where a pixel of the tile shows no surface, the highest is 1e30.
#include "lib/frame.glsl"

layout(binding = kTargetUnit) uniform sampler2D depth_texture;
layout(location = 0) out vec2 range;

void main() {
    ivec2 size = textureSize(depth_texture, 0);
    ivec2 begin = ivec2(gl_FragCoord.xy) * TILE_PX;
    ivec2 end = min(begin + TILE_PX, size);
    // Of the stored numbers, whichever way they grow: only the two ends become distances. A gather reads four texels in
    // little more than the time of one; beyond the picture's edge it repeats the tile's own.
    vec2 texel = 1.0 / vec2(size);
    vec4 lows = vec4(2.0), highs = vec4(-1.0);
    bool covered = true;
    for (int y = begin.y; y < end.y; y += 2) {
        for (int x = begin.x; x < end.x; x += 2) {
            vec4 depths = textureGather(depth_texture, vec2(x + 1, y + 1) * texel);
            bvec4 surface = notEqual(depths, vec4(frame.depth_clear));
            lows = min(lows, mix(vec4(2.0), depths, surface));
            highs = max(highs, mix(vec4(-1.0), depths, surface));
            covered = covered && all(surface);
        }
    }
    float low = min(min(lows.x, lows.y), min(lows.z, lows.w));
    float high = max(max(highs.x, highs.y), max(highs.z, highs.w));
    float a = view_distance(max(low - DEPTH_STEP, 0.0)), b = view_distance(min(high + DEPTH_STEP, 1.0));
    range = low > high ? vec2(1e30, 0.0) : vec2(min(a, b), max(a, b));
#ifdef WITH_BACKGROUND
    if (!covered) range.y = 1e30;
#endif
}
