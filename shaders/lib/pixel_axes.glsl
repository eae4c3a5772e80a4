// A pixel's own axes in the world, as columns: z from what it shows towards the eye, y as near to the view's up as that
// allows. Flat ground that is seen faces z, wherever in the picture it is.
#include "lib/frame.glsl"

mat3 world_from_pixel(ivec2 pixel) {
    vec2 ndc = (vec2(pixel) + 0.5) * vec2(frame.pixel_to_ndc_x, frame.pixel_to_ndc_y) - 1.0;
    vec3 z = -normalize(ndc.x * frame.ray_right + ndc.y * frame.ray_up + frame.ray_forward);
    vec3 x = normalize(cross(frame.ray_up, z));
    return mat3(x, cross(z, x), z);
}
