// fields: normal
// channels: signed signed
// domain: hemisphere
// summary: the octahedral map's front half, turned by 45 degrees to fill the square; the back is clamped
// source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), listing 3 (hemi-oct)
#include "lib/view.glsl"

vec2 encode_hemi_oct(vec3 n) {
    vec3 v = view_from_world(n);
    v.z = max(v.z, 0.0);
    // 1e-12: straight away from the viewer nothing is left of v.
    vec2 p = v.xy / max(abs(v.x) + abs(v.y) + v.z, 1e-12);
    return vec2(p.x + p.y, p.x - p.y);
}

vec3 decode_hemi_oct(vec2 e) {
    vec2 p = vec2(e.x + e.y, e.x - e.y) * 0.5;
    return normalize(world_from_view(vec3(p, 1.0 - abs(p.x) - abs(p.y))));
}
