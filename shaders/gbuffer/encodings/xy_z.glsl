// fields: normal
// channels: signed signed
// needs: pixel
// domain: hemisphere
// summary: x and y about the pixel's eye ray, z from the unit length; the back is clamped, and the silhouette is coarse
// source: Pranckevicius 2009, "Compact Normal Storage for Small G-Buffers", method 1 (store X & Y, reconstruct Z)
#include "lib/guards.glsl"
#include "lib/pixel_axes.glsl"

vec2 encode_xy_z(vec3 n, ivec2 pixel) {
    vec3 v = n * world_from_pixel(pixel);  // by the transpose, its inverse
    float across = dot(v.xy, v.xy);
    return v.z >= 0.0 ? v.xy : v.xy * inversesqrt(GUARDED(max(across, 1e-12), across));
}

// Rounding may push (x, y) out of the unit disc.
vec3 decode_xy_z(vec2 e, ivec2 pixel) {
    float z_squared = 1.0 - dot(e, e);
    return normalize(world_from_pixel(pixel) * vec3(e, sqrt(GUARDED(max(z_squared, 0.0), z_squared))));
}
