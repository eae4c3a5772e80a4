// Adds one light to the surface under this pixel. MAY_BE_BACKGROUND: there may be none.
#include "lib/gbuffer_pixel.glsl"
#include "lib/shade.glsl"

layout(location = kLightIndexUniform) uniform uint light_index;
layout(location = 0) out vec4 color;

void main() {
    float depth = pixel_depth();
#ifdef MAY_BE_BACKGROUND
    if (is_background(depth)) discard;
#endif
    Surface s = read_surface(gl_FragCoord.xy, depth);
    color = vec4(shade_local(s, light_at(light_index)), 0.0);
}
