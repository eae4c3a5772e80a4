// fields: base_color specular
// channels: unsigned unsigned unsigned
// summary: square root, so that dark colours keep their bits; close to sRGB at the price of one sqrt
// source: Valient 2007, "Deferred Rendering in Killzone 2" (gamma-space albedo); the exponent 2 is the usual short cut
#include "lib/guards.glsl"

vec3 encode_gamma2(vec3 c) { return sqrt(GUARDED(max(c, vec3(0.0)), c)); }
vec3 decode_gamma2(vec3 e) { return e * e; }
