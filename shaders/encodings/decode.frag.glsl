// Reads each pixel's value back. Every pixel holds one.
#include "encodings/samples.glsl"

bool has_surface(ivec2 pixel) { return true; }

#include "generated/gbuffer.glsl"

layout(location = 0) out vec4 value;

void main() { value = to_sample(read_surface(gl_FragCoord.xy, 0.0).FIELD); }
