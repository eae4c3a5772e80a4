// fields: normal
// channels: signed signed
// needs: grid
// summary: octahedral, and of the four stored values around the exact one the nearest in angle
// source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), section 3.3 (oct-P)
#include "gbuffer/encodings/oct.glsl"

vec3 decode_oct_precise(vec2 e) { return decode_oct(e); }

vec2 encode_oct_precise(vec3 n, vec2 grid_step, vec2 grid_offset) {
    vec2 low = floor((encode_oct(n) - grid_offset) / grid_step);
    vec2 best = vec2(0.0);
    float least = 8.0;
    for (int i = 0; i < 4; ++i) {
        vec2 e = clamp((low + vec2(i & 1, i >> 1)) * grid_step + grid_offset, -1.0, 1.0);
        // The chord, not the cosine: 1 - cos of a small angle is nothing in 32 bits.
        vec3 chord = decode_oct(e) - n;
        float error = dot(chord, chord);
        if (error < least) {
            least = error;
            best = e;
        }
    }
    return best;
}
