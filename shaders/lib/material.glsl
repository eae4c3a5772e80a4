// From a fragment of a mesh to its Surface: factors times textures, normal map, alpha mask. HAS_* come from SceneNeeds.
#include "lib/surface.glsl"
#include "shared/slots.h"
#include "shared/types.h"

layout(std140, binding = kMaterialBlock) uniform MaterialBlock { MaterialData material; };

#ifdef HAS_BASE_COLOR_TEXTURE
layout(binding = kBaseColorUnit) uniform sampler2D base_color_texture;
#endif
#ifdef HAS_METALLIC_ROUGHNESS_TEXTURE
layout(binding = kMetallicRoughnessUnit) uniform sampler2D metallic_roughness_texture;
#endif
#ifdef HAS_NORMAL_TEXTURE
layout(binding = kNormalUnit) uniform sampler2D normal_texture;
#endif
#ifdef HAS_EMISSIVE_TEXTURE
layout(binding = kEmissiveUnit) uniform sampler2D emissive_texture;
#endif

// The filtered texel at `uv`. GL finds the mip level from neighbouring fragments: of the same triangle where meshes are
// drawn, but not in a full-screen pass, which says with MATERIAL_GRADIENTS that it sets `uv_per_pixel`.
#ifdef MATERIAL_GRADIENTS
mat2 uv_per_pixel;  // columns: the difference to the next pixel in x, in y
vec4 sample_material(sampler2D map, vec2 uv) { return textureGrad(map, uv, uv_per_pixel[0], uv_per_pixel[1]); }
#else
vec4 sample_material(sampler2D map, vec2 uv) { return texture(map, uv); }
#endif

// Discards what nobody sees: what the alpha mask cuts away, and, with KEEPS_BACK_FACES, where the rasteriser culls
// nothing, the back faces of single-sided materials.
void discard_unseen(vec2 uv) {
#ifdef KEEPS_BACK_FACES
    if (!gl_FrontFacing && material.double_sided == 0u) discard;
#endif
#if defined(HAS_ALPHA_MASK) && defined(HAS_BASE_COLOR_TEXTURE)
    if (sample_material(base_color_texture, uv).a < material.alpha_cutoff) discard;
#endif
}

// Unit length for any finite vector that is not tiny; `fallback` for the rest.
vec3 safe_normalize(vec3 v, vec3 fallback) {
    float length_squared = dot(v, v);
    return length_squared > 1e-16 ? v * inversesqrt(length_squared) : fallback;
}

Surface evaluate_material(vec3 position, vec3 normal, vec4 tangent, vec2 uv, bool front_facing) {
    Surface s;
    s.position = position;
    // A triangle whose normals cancel out faces the viewer: shading it stays finite.
    s.normal = safe_normalize(normal, vec3(0.0, 1.0, 0.0));
#ifdef HAS_NORMAL_TEXTURE
    // glTF 2.0, 3.9.3: tangent space, bitangent = cross(normal, tangent) * w. Left unnormalised as MikkTSpace asks.
    vec3 mapped = sample_material(normal_texture, uv).xyz * 2.0 - 1.0;
    mapped.xy *= material.normal_scale;
    vec3 bitangent = cross(normal, tangent.xyz) * tangent.w;
    s.normal = safe_normalize(mapped.x * tangent.xyz + mapped.y * bitangent + mapped.z * normal, s.normal);
#endif
#ifdef HAS_DOUBLE_SIDED
    if (!front_facing) s.normal = -s.normal;
#endif
    s.base_color = material.base_color;
#ifdef HAS_BASE_COLOR_TEXTURE
    s.base_color *= sample_material(base_color_texture, uv).rgb;
#endif
    s.roughness = material.roughness;
    s.metallic = material.metallic;
#ifdef HAS_METALLIC_ROUGHNESS_TEXTURE
    vec2 roughness_metallic = sample_material(metallic_roughness_texture, uv).gb;
    s.roughness *= roughness_metallic.x;
    s.metallic *= roughness_metallic.y;
#endif
    s.specular = material.specular * mix(1.0, luminance(s.base_color), material.specular_from_luminance);
    s.emissive = material.emissive;
#ifdef HAS_EMISSIVE_TEXTURE
    s.emissive *= sample_material(emissive_texture, uv).rgb;
#endif
    s.model = material.model;
    return s;
}
