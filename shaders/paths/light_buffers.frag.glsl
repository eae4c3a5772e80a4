// light_prepass: every light on a surface of which only normal, roughness and model are known. The lobes are summed
// apart, for the material to weigh them (reflect_lobes). LARGEST: of the buffers' format, where that ends before float.
// MAY_BE_BACKGROUND: there may be no surface.
#include "lib/gbuffer_pixel.glsl"
#include "lib/shade.glsl"

layout(location = 0) out vec4 diffuse;
#if defined(HAS_GGX) || defined(HAS_BLINN_PHONG)
layout(location = 1) out vec4 f0;
#endif
#ifdef HAS_GGX
layout(location = 2) out vec4 f90;
#endif

// Infinity times a colour of zero would be no number.
vec4 stored(vec3 sum) {
#ifdef LARGEST
    sum = min(sum, vec3(LARGEST));
#endif
    return vec4(sum, 0.0);
}

void main() {
    LobeSums sums = kNoLight;
    float depth = pixel_depth();
#ifdef MAY_BE_BACKGROUND
    if (!is_background(depth))
#endif
        sums = sum_lights(read_surface(gl_FragCoord.xy, depth));
    diffuse = stored(sums.diffuse);
#if defined(HAS_GGX) || defined(HAS_BLINN_PHONG)
    f0 = stored(sums.f0);
#endif
#ifdef HAS_GGX
    f90 = stored(sums.f90);
#endif
}
