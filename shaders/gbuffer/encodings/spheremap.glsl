// fields: normal
// channels: signed signed
// summary: Lambert's azimuthal equal-area map to the unit disc; one pole becomes its rim
// source: Pranckevicius 2009, "Compact Normal Storage for Small G-Buffers", method 4; Lambert 1772
#include "lib/guards.glsl"

vec2 encode_spheremap(vec3 n) {
    // |e| = sqrt((1 - z) / 2), in whichever form does not cancel. Any point of the rim is the pole.
    if (n.z >= 0.0) return n.xy * inversesqrt(2.0 + 2.0 * n.z);
    float across = length(n.xy);
    vec2 scaled = n.xy * (sqrt(0.5 - 0.5 * n.z) / across);
    return GUARDED(across > 0.0 ? scaled : vec2(1.0, 0.0), scaled);
}

vec3 decode_spheremap(vec2 e) {
    float r2 = dot(e, e);
    return normalize(vec3(e * (2.0 * sqrt(GUARDED(max(1.0 - r2, 0.0), 1.0 - r2))), 1.0 - 2.0 * r2));
}
