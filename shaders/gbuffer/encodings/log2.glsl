// fields: roughness
// channels: unsigned
// summary: logarithm, steps in proportion to the value from about 1/31 on; 0 and 1 are exact
// source: the compression law of ITU-T G.711 with mu = 31, log2(1 + 31 r) / 5
#include "lib/guards.glsl"

float encode_log2(float v) { return log2(1.0 + 31.0 * GUARDED(max(v, 0.0), v)) * 0.2; }
float decode_log2(float e) { return (exp2(5.0 * e) - 1.0) * (1.0 / 31.0); }
