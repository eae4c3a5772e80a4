// The frame's constants, and what a pixel and a depth say about a place.
#include "shared/slots.h"
#include "shared/types.h"

layout(std140, binding = kFrameBlock) uniform FrameBlock { FrameData frame; };

// Distance along the view axis; the inverse of the projection's depth row (see camera_projection in renderer/frame).
// Depth counts from the far plane, where standard depths crowd: the difference is exact. From zero the offset would be
// -f / (f - n), which rounds to -1 when far is 2^24 times as far as near, and divides by zero.
float view_distance(float depth) { return frame.depth_scale / ((depth - frame.depth_clear) + frame.depth_offset); }

// From the eye through `frag_coord`, one unit long along the view axis.
vec3 pixel_ray(vec2 frag_coord) {
    vec2 ndc = frag_coord * vec2(frame.pixel_to_ndc_x, frame.pixel_to_ndc_y) - 1.0;
    return ndc.x * frame.ray_right + ndc.y * frame.ray_up + frame.ray_forward;
}

// Camera-relative position of the surface at `depth` under the pixel centre gl_FragCoord.xy.
vec3 position_from_depth(vec2 frag_coord, float depth) { return view_distance(depth) * pixel_ray(frag_coord); }
