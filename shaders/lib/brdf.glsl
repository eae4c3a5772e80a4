// The shading models. HAS_<MODEL> come from SceneNeeds; MULTIPLE_MODELS when a scene has more than one.
#include "lib/surface.glsl"

const float kPi = 3.14159265358979;
// The smallest alpha: sharper lobes than this are narrower than a light's angular size ever is, and overflow half floats.
const float kMinAlpha = 0.002;

// GGX, height-correlated Smith visibility, Schlick's Fresnel, Lambert diffuse below a dielectric of F0 0.04
// (glTF 2.0, appendix B). Already multiplied by N.L.
vec3 ggx(Surface s, vec3 v, vec3 l, float n_dot_l) {
    vec3 h = normalize(v + l);
    float n_dot_v = max(dot(s.normal, v), 1e-4);
    float v_dot_h = clamp(dot(v, h), 0.0, 1.0);
    float alpha = max(s.roughness * s.roughness, kMinAlpha);
    float alpha2 = alpha * alpha;
    // 1 - (n.h)^2 as |n x h|^2 (Lagrange): the difference would cancel to nothing in a sharp highlight.
    vec3 n_cross_h = cross(s.normal, h);
    float sin2 = dot(n_cross_h, n_cross_h);
    float n_dot_h = dot(s.normal, h);
    float denominator = n_dot_h * n_dot_h * alpha2 + sin2;
    float distribution = n_dot_h > 0.0 ? alpha2 / (kPi * denominator * denominator) : 0.0;
    // Heitz 2014: V = 0.5 / (n.l sqrt((n.v)^2 (1 - a2) + a2) + n.v sqrt((n.l)^2 (1 - a2) + a2))
    float lambda_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - alpha2) + alpha2);
    float lambda_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2);
    float visibility = 0.5 / (lambda_v + lambda_l);
    vec3 f0 = mix(vec3(0.04), s.base_color, s.metallic);
    float m = 1.0 - v_dot_h;
    float m2 = m * m;
    vec3 fresnel = f0 + (1.0 - f0) * (m2 * m2 * m);
    vec3 diffuse = (1.0 - fresnel) * (1.0 - s.metallic) * s.base_color * (1.0 / kPi);
    return (diffuse + fresnel * (distribution * visibility)) * n_dot_l;
}

// Blinn-Phong with the energy factor (e + 8) / 8 pi (Akenine-Moeller et al., Real-Time Rendering, 3rd ed., 7.6).
vec3 blinn_phong(Surface s, vec3 v, vec3 l, float n_dot_l) {
    vec3 h = normalize(v + l);
    float alpha = max(s.roughness * s.roughness, kMinAlpha);
    float exponent = max(2.0 / (alpha * alpha) - 2.0, 0.0);
    // (n.h)^e as exp2(e log2) with a floor: pow(0, 0) differs between drivers.
    float n_dot_h = max(dot(s.normal, h), 1e-20);
    float lobe = (exponent + 8.0) * (1.0 / (8.0 * kPi)) * exp2(exponent * log2(min(n_dot_h, 1.0)));
    return (s.base_color * (1.0 / kPi) + s.specular * lobe) * n_dot_l;
}

vec3 lambert(Surface s, float n_dot_l) { return s.base_color * (n_dot_l / kPi); }

// Reflected radiance per unit irradiance from `l` towards `v` (both unit, away from the surface).
vec3 reflect_light(Surface s, vec3 v, vec3 l) {
    float n_dot_l = dot(s.normal, l);
    if (n_dot_l <= 0.0) return vec3(0.0);
#ifdef HAS_BLINN_PHONG
#ifdef MULTIPLE_MODELS
    if (s.model == MODEL_BLINN_PHONG)
#endif
        return blinn_phong(s, v, l, n_dot_l);
#endif
#ifdef HAS_LAMBERT
#ifdef MULTIPLE_MODELS
    if (s.model == MODEL_LAMBERT)
#endif
        return lambert(s, n_dot_l);
#endif
#ifdef HAS_GGX
    return ggx(s, v, l, n_dot_l);
#endif
}
