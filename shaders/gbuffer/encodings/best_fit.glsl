// fields: normal
// channels: signed signed signed
// needs: grid
// summary: three components at the length whose rounding errs least; searched in the shader, so encoding is slow
// source: Kaplanyan 2010, "CryENGINE 3: Reaching the Speed of Light", SIGGRAPH Advances in Real-Time Rendering
//
// Kaplanyan looks the length up in a cube map made beforehand; the search needs no table and fits every format. It costs
// two thirds of a channel's positive values in steps: 86 with 8 bits, 342 with 10.
#include "lib/safe_normalize.glsl"

vec3 encode_best_fit(vec3 n, vec3 grid_step, vec3 grid_offset) {
    vec3 size = abs(n);
    // Everything on one grid: the channels of a layout have the same bits, or the largest step serves.
    float s = max(grid_step.x, max(grid_step.y, grid_step.z));
    vec3 direction = n / max(size.x, max(size.y, size.z));
    vec3 best = n;
    float least = 8.0;
    // The largest component at each value it can have from 1/3 to 1. The rest of the way to zero repeats these directions:
    // a vector of integers that is short has a multiple by 2, of odd integers by 3, that is not.
    // 1 / s is n, or n + 1/2 where the grid has no zero: n of either, though the division is not exact.
    int count = int(1.0 / s + 0.25);
    for (int k = count / 3; k <= count; ++k) {
        float longest = min(float(k) * s + grid_offset.x, 1.0);
        vec3 e = round((direction * longest - grid_offset) / grid_step) * grid_step + grid_offset;
        // sin^2 of the angle; its cosine would round to 1.
        vec3 c = cross(n, e);
        float error = dot(c, c) / dot(e, e);
        if (error < least) {
            least = error;
            best = e;
        }
    }
    return clamp(best, -1.0, 1.0);
}

// As decode_xyz.
vec3 decode_best_fit(vec3 e) { return safe_normalize(e, vec3(0.0, 0.0, 1.0)); }
