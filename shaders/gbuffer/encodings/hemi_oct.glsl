// fields: normal
// channels: signed signed
// needs: pixel
// domain: hemisphere
// summary: the octahedral map's half that faces the pixel's eye ray, turned by 45 degrees to fill the square; the rest is clamped
// source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), listing 3 (hemi-oct)
#include "lib/guards.glsl"
#include "lib/pixel_axes.glsl"

vec2 encode_hemi_oct(vec3 n, ivec2 pixel) {
    vec3 v = n * world_from_pixel(pixel);  // by the transpose, its inverse
    v.z = max(v.z, 0.0);
    // Straight away from the eye nothing is left of v.
    float size = abs(v.x) + abs(v.y) + v.z;
    vec2 p = v.xy / GUARDED(max(size, 1e-12), size);
    return vec2(p.x + p.y, p.x - p.y);
}

vec3 decode_hemi_oct(vec2 e, ivec2 pixel) {
    vec2 p = vec2(e.x + e.y, e.x - e.y) * 0.5;
    return normalize(world_from_pixel(pixel) * vec3(p, 1.0 - abs(p.x) - abs(p.y)));
}
