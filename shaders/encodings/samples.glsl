// What `lightsweep encodings` sends through an encoding: one value for each pixel. FIELD names the member of Surface.
layout(binding = 0) uniform sampler2D samples;

vec4 sample_of(ivec2 pixel) { return texelFetch(samples, pixel, 0); }

void from_sample(vec4 v, out vec3 field) { field = v.xyz; }
void from_sample(vec4 v, out float field) { field = v.x; }
void from_sample(vec4 v, out uint field) { field = uint(v.x); }

vec4 to_sample(vec3 field) { return vec4(field, 0.0); }
vec4 to_sample(float field) { return vec4(field, 0.0, 0.0, 0.0); }
vec4 to_sample(uint field) { return vec4(float(field), 0.0, 0.0, 0.0); }
