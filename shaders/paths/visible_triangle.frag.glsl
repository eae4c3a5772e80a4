// What the reference takes from the rasteriser: which triangle each pixel centre sees, and the texels sampled there,
// before any factor.
#include "lib/material.glsl"

layout(location = 0) in vec2 in_texcoord;
layout(location = 4) flat in uint in_instance;

layout(location = 0) out uvec2 visible;  // instance + 1 (0: background), triangle of the mesh
#ifdef OUTPUT_TEXELS
layout(location = 1) out vec4 base_color_roughness;
layout(location = 2) out vec4 normal_metallic;
layout(location = 3) out vec4 emissive;
#endif

void main() {
    discard_unseen(in_texcoord);
    visible = uvec2(in_instance + 1u, uint(gl_PrimitiveID));
#ifdef OUTPUT_TEXELS
    base_color_roughness = vec4(1.0);
    normal_metallic = vec4(0.5, 0.5, 1.0, 1.0);
    emissive = vec4(1.0);
#ifdef HAS_BASE_COLOR_TEXTURE
    base_color_roughness.rgb = texture(base_color_texture, in_texcoord).rgb;
#endif
#ifdef HAS_METALLIC_ROUGHNESS_TEXTURE
    vec2 roughness_metallic = texture(metallic_roughness_texture, in_texcoord).gb;
    base_color_roughness.a = roughness_metallic.x;
    normal_metallic.a = roughness_metallic.y;
#endif
#ifdef HAS_NORMAL_TEXTURE
    normal_metallic.rgb = texture(normal_texture, in_texcoord).rgb;
#endif
#ifdef HAS_EMISSIVE_TEXTURE
    emissive.rgb = texture(emissive_texture, in_texcoord).rgb;
#endif
#endif
}
