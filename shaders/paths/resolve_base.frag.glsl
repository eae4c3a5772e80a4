// deferred_scissor, deferred_volumes: what no single light adds (emission, ambient, directional lights, background).
// MAY_BE_BACKGROUND: there may be no surface.
#include "lib/gbuffer_pixel.glsl"
#include "lib/shade.glsl"

layout(location = 0) out vec4 color;

void main() {
    float depth = pixel_depth();
#ifdef MAY_BE_BACKGROUND
    if (is_background(depth)) {
        color = vec4(frame.background, 1.0);
        return;
    }
#endif
    Surface s = read_surface(gl_FragCoord.xy, depth);
    color = vec4(shade_base(s), 1.0);
}
