// fields: roughness metallic
// channels: unsigned
// summary: square root, so that smooth surfaces keep their bits
// source: none needed
#include "lib/guards.glsl"

float encode_sqrt(float v) { return sqrt(GUARDED(max(v, 0.0), v)); }
float decode_sqrt(float e) { return e * e; }
