// From a fragment of a mesh to its Surface: factors times textures, normal map, alpha mask. HAS_* come from SceneNeeds.
#include "lib/safe_normalize.glsl"
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

// The filtered texel at `uv`, and which way the triangle faces: towards the eye, of any length. GL finds the mip level
// from neighbouring fragments: of the same triangle where meshes are drawn, but not in a full-screen pass, which says
// with MATERIAL_GRADIENTS that it sets `uv_per_pixel` and `triangle_normal`.
#ifdef MATERIAL_GRADIENTS
mat2 uv_per_pixel;  // columns: the difference to the next pixel in x, in y
vec3 triangle_normal;
vec4 sample_material(sampler2D map, vec2 uv) { return textureGrad(map, uv, uv_per_pixel[0], uv_per_pixel[1]); }
vec3 facing_normal(vec3 position) { return triangle_normal; }
#else
vec4 sample_material(sampler2D map, vec2 uv) { return texture(map, uv); }
vec3 facing_normal(vec3 position) { return cross(dFdx(position), dFdy(position)); }
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

// Interpolated normals shorter than this have cancelled out.
const float kShortestNormal = 1e-8;
// A normal map's vector shorter than this, filtered from texels in steps of 1/255, points anywhere.
const float kShortestMapped = 1e-4;
// A tangent at a smaller angle to the normal than this has no direction across it.
const float kSmallestSine = 1e-3;

// `normal`, or the triangle's own, where the vertices say nothing: they cancel out, are zero or not finite.
vec3 usable_normal(vec3 normal, vec3 position, bool front_facing) {
    vec3 facing = facing_normal(position);
    if (dot(normal, normal) > kShortestNormal * kShortestNormal) return normal;  // NaN is not above
    return safe_normalize(front_facing ? facing : -facing, vec3(0.0, 1.0, 0.0));
}

// `tangent`, or any across the normal, of the same handedness, where it has no such direction: it is zero, not finite,
// or along the normal.
vec4 usable_tangent(vec3 normal, vec4 tangent) {
    vec3 turned = cross(normal, tangent.xyz);
    float least = kSmallestSine * kSmallestSine * dot(normal, normal) * dot(tangent.xyz, tangent.xyz);
    if (dot(turned, turned) * tangent.w * tangent.w > least) return tangent;
    // The normal's part in the plane of y and the larger of x and z, a quarter turned (Hughes and Moeller 1999).
    vec3 across = abs(normal.x) > abs(normal.z) ? vec3(-normal.y, normal.x, 0.0) : vec3(0.0, -normal.z, normal.y);
    return vec4(safe_normalize(across, vec3(1.0, 0.0, 0.0)), tangent.w < 0.0 ? -1.0 : 1.0);
}

// Of a normal map's vector, in the world, unit (glTF 2.0, 3.9.3: bitangent = cross(normal, tangent) * w). Normal and
// tangent come interpolated and are left unnormalised as MikkTSpace asks. `fallback` where the map says nothing.
vec3 from_tangent_space(vec3 mapped, vec3 normal, vec4 frame_tangent, vec3 fallback) {
    vec4 tangent = GUARDED(usable_tangent(normal, frame_tangent), frame_tangent);
    vec3 bitangent = cross(normal, tangent.xyz) * tangent.w;
    vec3 bent = safe_normalize(mapped.x * tangent.xyz + mapped.y * bitangent + mapped.z * normal, fallback);
    return GUARDED(dot(mapped, mapped) > kShortestMapped * kShortestMapped ? bent : fallback, bent);
}

Surface evaluate_material(vec3 position, vec3 normal, vec4 tangent, vec2 uv, bool front_facing) {
    Surface s;
    s.position = position;
    normal = GUARDED(usable_normal(normal, position, front_facing), normal);
    s.normal = safe_normalize(normal, vec3(0.0, 1.0, 0.0));
#ifdef HAS_NORMAL_TEXTURE
    vec3 mapped = sample_material(normal_texture, uv).xyz * 2.0 - 1.0;
    mapped.xy *= material.normal_scale;
    s.normal = from_tangent_space(mapped, normal, tangent, s.normal);
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
