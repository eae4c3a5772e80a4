// A full-screen pass's view of the G-buffer: the surface under this pixel, or none.
#include "lib/frame.glsl"
#include "lib/surface.glsl"

layout(binding = DEPTH_UNIT) uniform sampler2D depth_texture;

float pixel_depth() { return texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r; }

bool is_background(float depth) { return depth == frame.depth_clear; }

// Of a pixel inside the picture. Where there is none, the G-buffer holds whatever was there before.
bool has_surface(ivec2 pixel) { return !is_background(texelFetch(depth_texture, pixel, 0).r); }

#include "generated/gbuffer.glsl"
