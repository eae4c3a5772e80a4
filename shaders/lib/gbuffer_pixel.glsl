// A full-screen pass's view of the G-buffer: the surface under this pixel, or none.
#include "lib/frame.glsl"
#include "lib/surface.glsl"
#include "generated/gbuffer.glsl"

layout(binding = DEPTH_UNIT) uniform sampler2D depth_texture;

float pixel_depth() { return texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r; }

bool is_background(float depth) { return depth == frame.depth_clear; }
