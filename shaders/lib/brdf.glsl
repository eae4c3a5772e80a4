// The shading models. HAS_<MODEL> come from SceneNeeds; MULTIPLE_MODELS when a scene has more than one.
//
// Each is a sum of products: what normal, roughness, view and light decide (Lobes), times what the other fields of the
// material decide. So lobes are summed over lights, and the material comes last.
#include "lib/surface.glsl"

const float kPi = 3.14159265358979;
// The smallest alpha: sharper lobes than this are narrower than a light's angular size ever is, and overflow half
// floats.
const float kMinAlpha = 0.002;

// Already multiplied by N.L.
struct Lobes {
    float diffuse;
    float f0;   // of the reflectance at normal incidence
    float f90;  // of full reflectance, at grazing angles
};

// GGX, height-correlated Smith visibility, Schlick's Fresnel, Lambert diffuse below a dielectric of F0 0.04
// (glTF 2.0, appendix B). Schlick's F = F0 (1 - m^5) + m^5, and so 1 - F = (1 - F0) (1 - m^5), with m = 1 - v.h.
Lobes ggx(vec3 normal, float roughness, vec3 v, vec3 l, float n_dot_l) {
    vec3 h = normalize(v + l);
    float n_dot_v = max(dot(normal, v), 1e-4);
    float v_dot_h = clamp(dot(v, h), 0.0, 1.0);
    float alpha = max(roughness * roughness, kMinAlpha);
    float alpha2 = alpha * alpha;
    // 1 - (n.h)^2 as |n x h|^2 (Lagrange): the difference would cancel to nothing in a sharp highlight.
    vec3 n_cross_h = cross(normal, h);
    float sin2 = dot(n_cross_h, n_cross_h);
    float n_dot_h = dot(normal, h);
    float denominator = n_dot_h * n_dot_h * alpha2 + sin2;
    float distribution = n_dot_h > 0.0 ? alpha2 / (kPi * denominator * denominator) : 0.0;
    // Heitz 2014: V = 0.5 / (n.l sqrt((n.v)^2 (1 - a2) + a2) + n.v sqrt((n.l)^2 (1 - a2) + a2))
    float lambda_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - alpha2) + alpha2);
    float lambda_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2);
    float visibility = 0.5 / (lambda_v + lambda_l);
    float specular = distribution * visibility * n_dot_l;
    float m = 1.0 - v_dot_h;
    float m2 = m * m;
    float m5 = m2 * m2 * m;
    return Lobes((1.0 - m5) * n_dot_l, (1.0 - m5) * specular, m5 * specular);
}

// Blinn-Phong with the energy factor (e + 8) / 8 pi (Akenine-Moeller et al., Real-Time Rendering, 3rd ed., 7.6).
Lobes blinn_phong(vec3 normal, float roughness, vec3 v, vec3 l, float n_dot_l) {
    vec3 h = normalize(v + l);
    float alpha = max(roughness * roughness, kMinAlpha);
    float exponent = max(2.0 / (alpha * alpha) - 2.0, 0.0);
    // (n.h)^e as exp2(e log2) with a floor: pow(0, 0) differs between drivers.
    float n_dot_h = max(dot(normal, h), 1e-20);
    float lobe = (exponent + 8.0) * (1.0 / (8.0 * kPi)) * exp2(exponent * log2(min(n_dot_h, 1.0)));
    return Lobes(n_dot_l, lobe * n_dot_l, 0.0);
}

Lobes lambert(float n_dot_l) { return Lobes(n_dot_l, 0.0, 0.0); }

// Of light from `l` that leaves towards `v` (both unit, away from the surface).
Lobes light_lobes(vec3 normal, float roughness, uint model, vec3 v, vec3 l) {
    float n_dot_l = dot(normal, l);
    if (n_dot_l <= 0.0) return Lobes(0.0, 0.0, 0.0);
#ifdef HAS_BLINN_PHONG
#ifdef MULTIPLE_MODELS
    if (model == MODEL_BLINN_PHONG)
#endif
        return blinn_phong(normal, roughness, v, l, n_dot_l);
#endif
#ifdef HAS_LAMBERT
#ifdef MULTIPLE_MODELS
    if (model == MODEL_LAMBERT)
#endif
        return lambert(n_dot_l);
#endif
#ifdef HAS_GGX
    return ggx(normal, roughness, v, l, n_dot_l);
#endif
}

// Lobes times irradiance, summed over lights.
struct LobeSums {
    vec3 diffuse, f0, f90;
};
const LobeSums kNoLight = LobeSums(vec3(0.0), vec3(0.0), vec3(0.0));

// Reflected radiance. Of the surface, the material alone counts.
vec3 reflect_lobes(Surface s, LobeSums lights) {
    vec3 albedo = s.base_color * (1.0 / kPi);
#ifdef HAS_BLINN_PHONG
#ifdef MULTIPLE_MODELS
    if (s.model == MODEL_BLINN_PHONG)
#endif
        return albedo * lights.diffuse + s.specular * lights.f0;
#endif
#ifdef HAS_LAMBERT
#ifdef MULTIPLE_MODELS
    if (s.model == MODEL_LAMBERT)
#endif
        return albedo * lights.diffuse;
#endif
#ifdef HAS_GGX
    vec3 reflectance = mix(vec3(0.04), s.base_color, s.metallic);
    return (1.0 - reflectance) * (1.0 - s.metallic) * albedo * lights.diffuse + reflectance * lights.f0 + lights.f90;
#endif
}
