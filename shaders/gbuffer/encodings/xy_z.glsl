// fields: normal
// channels: signed signed
// domain: hemisphere
// summary: x and y in view space, z from the unit length; the back is clamped, and the silhouette is coarse
// source: Pranckevicius 2009, "Compact Normal Storage for Small G-Buffers", method 1 (store X & Y, reconstruct Z)
#include "lib/view.glsl"

vec2 encode_xy_z(vec3 n) {
    vec3 v = view_from_world(n);
    return v.z >= 0.0 ? v.xy : v.xy * inversesqrt(max(dot(v.xy, v.xy), 1e-12));
}

// Rounding may push (x, y) out of the unit disc.
vec3 decode_xy_z(vec2 e) { return normalize(world_from_view(vec3(e, sqrt(max(1.0 - dot(e, e), 0.0))))); }
