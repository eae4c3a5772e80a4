// One point for each pixel centre, as far along the view axis as its sample says: the rasteriser encodes the depth.
#include "encodings/samples.glsl"
#include "lib/frame.glsl"

void main() {
    int width = textureSize(samples, 0).x;
    ivec2 pixel = ivec2(gl_VertexID % width, gl_VertexID / width);
    vec2 ndc = (vec2(pixel) + 0.5) * vec2(frame.pixel_to_ndc_x, frame.pixel_to_ndc_y) - 1.0;
    vec3 world = sample_of(pixel).x * (ndc.x * frame.ray_right + ndc.y * frame.ray_up + frame.ray_forward);
    gl_Position = frame.clip_from_world * vec4(world, 1.0);
}
