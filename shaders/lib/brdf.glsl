// The shading models. HAS_<MODEL> come from SceneNeeds; MULTIPLE_MODELS when a scene has more than one.
//
// Each is a sum of products: what normal, roughness, view and light decide (Lobes), times what the other fields of the
// material decide. So lobes are summed over lights, and the material comes last.
#include "lib/guards.glsl"
#include "lib/surface.glsl"

const float kPi = 3.14159265358979;
// The smallest alpha: sharper lobes than this are narrower than a light's angular size ever is, and overflow half
// floats.
const float kMinAlpha = 0.002;
// The smallest cosine in the masking term, of view and light alike so that it stays reciprocal: an interpolated normal
// may face away.
const float kMinCosine = 1e-4;

// Already multiplied by N.L.
struct Lobes {
    float diffuse;
    float f0;   // of the reflectance at normal incidence
    float f90;  // of full reflectance, at grazing angles
};

struct HalfVector {
    vec3 direction;  // unit
    float v_dot_h;   // and l.h: half of |v + l|, which is the same for either to the last bit
};

// Of opposite vectors there is none: zero then, which no normal faces, and v.h is 0.
HalfVector half_vector(vec3 v, vec3 l) {
    vec3 sum = v + l;
    float length_squared = dot(sum, sum);
    float inverse_length = inversesqrt(GUARDED(max(length_squared, 1e-20), length_squared));
    vec3 h = sum * inverse_length;
    return HalfVector(h, GUARDED(min(0.5 * length_squared * inverse_length, 1.0), clamp(dot(v, h), 0.0, 1.0)));
}

// 1 - (n.h)^2 as |n x h|^2 (Lagrange): the difference would cancel to nothing in a sharp highlight.
float sine_squared(vec3 normal, vec3 h, float n_dot_h) {
    vec3 n_cross_h = cross(normal, h);
    return GUARDED(dot(n_cross_h, n_cross_h), 1.0 - n_dot_h * n_dot_h);
}

// GGX, height-correlated Smith visibility, Schlick's Fresnel, Lambert diffuse below a dielectric of F0 0.04
// (glTF 2.0, appendix B). Schlick's F = F0 (1 - m^5) + m^5, and so 1 - F = (1 - F0) (1 - m^5), with m = 1 - v.h.
Lobes ggx(vec3 normal, float roughness, vec3 v, vec3 l, float n_dot_l) {
    HalfVector h = half_vector(v, l);
    float alpha = GUARDED(max(roughness * roughness, kMinAlpha), roughness * roughness);
    float alpha2 = alpha * alpha;
    float n_dot_h = dot(normal, h.direction);
    float denominator = n_dot_h * n_dot_h * alpha2 + sine_squared(normal, h.direction, n_dot_h);
    float distribution = n_dot_h > 0.0 ? alpha2 / (kPi * denominator * denominator) : 0.0;
    // Heitz 2014: V = 0.5 / (n.l sqrt((n.v)^2 (1 - a2) + a2) + n.v sqrt((n.l)^2 (1 - a2) + a2))
    float cos_v = GUARDED(max(dot(normal, v), kMinCosine), dot(normal, v));
    float cos_l = GUARDED(max(n_dot_l, kMinCosine), n_dot_l);
    float lambda_v = cos_l * sqrt(cos_v * cos_v * (1.0 - alpha2) + alpha2);
    float lambda_l = cos_v * sqrt(cos_l * cos_l * (1.0 - alpha2) + alpha2);
    float visibility = 0.5 / (lambda_v + lambda_l);
    float specular = distribution * visibility * n_dot_l;
    float m = 1.0 - h.v_dot_h;
    float m2 = m * m;
    float m5 = m2 * m2 * m;
    return Lobes((1.0 - m5) * n_dot_l, (1.0 - m5) * specular, m5 * specular);
}

// log2 of n.h. Near 1, where a large exponent magnifies every rounding, from the sine: log(1 - sin^2) / 2 as a series,
// whose next term is below 2^-18 of it there. With a floor: pow(0, 0) differs between drivers.
float log2_facet(vec3 normal, vec3 h) {
    float n_dot_h = dot(normal, h);
    float sin2 = sine_squared(normal, h, n_dot_h);
    float near_one = -0.72134752 * sin2 * (1.0 + sin2 * (0.5 + sin2 * (0.33333333 + sin2 * 0.25)));
    return GUARDED(n_dot_h > 0.97 ? near_one : log2(max(n_dot_h, 1e-20)), log2(n_dot_h));
}

// Blinn-Phong with the energy factor (e + 8) / 8 pi (Akenine-Moeller et al., Real-Time Rendering, 3rd ed., 7.6).
Lobes blinn_phong(vec3 normal, float roughness, vec3 v, vec3 l, float n_dot_l) {
    float alpha = GUARDED(max(roughness * roughness, kMinAlpha), roughness * roughness);
    float exponent = 2.0 / (alpha * alpha) - 2.0;
    exponent = GUARDED(max(exponent, 0.0), exponent);
    float log2_cosine = log2_facet(normal, half_vector(v, l).direction);
    float lobe = (exponent + 8.0) * (1.0 / (8.0 * kPi)) * exp2(exponent * log2_cosine);
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
#ifdef COMPENSATED_SUMS
    vec3 diffuse_excess, f0_excess, f90_excess;  // what roundings have made the sums too large by
#endif
};
#ifdef COMPENSATED_SUMS
const LobeSums kNoLight = LobeSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
#else
const LobeSums kNoLight = LobeSums(vec3(0.0), vec3(0.0), vec3(0.0));
#endif

// Where sums of lights end, far from where floats do: an infinite one times a colour of zero would be no number.
const float kMostLight = 1e38;
vec3 bounded(vec3 light) {
    return GUARDED(mix(light, sign(light) * kMostLight, greaterThan(abs(light), vec3(kMostLight))), light);
}

// Reflected radiance. Of the surface, the material alone counts.
vec3 reflect_lobes(Surface s, LobeSums lights) {
    lights.diffuse = bounded(lights.diffuse);
    lights.f0 = bounded(lights.f0);
    lights.f90 = bounded(lights.f90);
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
