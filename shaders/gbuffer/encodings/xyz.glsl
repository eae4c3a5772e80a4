// fields: normal
// channels: signed signed signed
// summary: the three components as they are; decoding renormalises
// source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), section 3.1
#include "lib/safe_normalize.glsl"

vec3 encode_xyz(vec3 n) { return n; }

// A quantised vector is not of unit length, and a specular lobe would feel it. No unit vector is stored as zero, but a
// cleared or filtered texel may be.
vec3 decode_xyz(vec3 e) { return safe_normalize(e, vec3(0.0, 0.0, 1.0)); }
