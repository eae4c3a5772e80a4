// light_prepass: evaluates the material and weighs with it what the light buffers hold for this pixel.
#include "lib/mesh_surface.glsl"
#include "lib/shade.glsl"

layout(binding = kTargetUnit) uniform sampler2D diffuse_buffer;
#if defined(HAS_GGX) || defined(HAS_BLINN_PHONG)
layout(binding = kTargetUnit + 1) uniform sampler2D f0_buffer;
#endif
#ifdef HAS_GGX
layout(binding = kTargetUnit + 2) uniform sampler2D f90_buffer;
#endif

layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    LobeSums lights = kNoLight;
    lights.diffuse = texelFetch(diffuse_buffer, pixel, 0).rgb;
#if defined(HAS_GGX) || defined(HAS_BLINN_PHONG)
    lights.f0 = texelFetch(f0_buffer, pixel, 0).rgb;
#endif
#ifdef HAS_GGX
    lights.f90 = texelFetch(f90_buffer, pixel, 0).rgb;
#endif
    color = vec4(shade_lit(mesh_surface(), lights), 1.0);
}
