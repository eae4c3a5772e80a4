// Adds one light to the marked pixels.
#include "lib/gbuffer_pixel.glsl"
#include "lib/shade.glsl"

layout(location = kLightIndexUniform) uniform uint light_index;
layout(location = 0) out vec4 color;

void main() {
    float depth = pixel_depth();
    color = vec4(0.0);
    // A volume that reaches past the far plane marks the background too: there is no surface to light.
    if (is_background(depth)) return;
    Surface s = read_surface(gl_FragCoord.xy, depth);
    color = vec4(shade_local(s, view_direction(s), light_at(light_index)), 0.0);
}
