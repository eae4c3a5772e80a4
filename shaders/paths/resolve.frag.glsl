// Deferred, second half: read the surface back and shade it with every light. MAY_BE_BACKGROUND: there may be none.
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
    color = vec4(shade(read_surface(gl_FragCoord.xy, depth)), 1.0);
}
