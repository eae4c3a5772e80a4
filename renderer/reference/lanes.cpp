// The shading models. Sources: GGX, Schlick's Fresnel and the dielectric's 0.04 as in glTF 2.0, appendix B; masking
// after Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs"; Blinn-Phong's energy
// factor after Akenine-Moeller et al., Real-Time Rendering, 3rd ed., 7.6.
#include "renderer/reference/lanes.h"

#include "renderer/base/check.h"
#include "renderer/reference/clones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

using std::numbers::inv_pi;

constexpr double kMinAlpha = 0.002;   // sharper lobes are narrower than any light
constexpr double kMinCosine = 1e-4;   // of view and light, in the masking term
constexpr double kMinFacet = 1e-20;   // of n.h, in Blinn-Phong's power
constexpr double kDielectric = 0.04;  // reflectance of what is no metal, seen straight on

double squared_alpha(double roughness) {
    const double alpha = std::max(roughness * roughness, kMinAlpha);
    return alpha * alpha;
}

// The half vector, not unit, as a part along the normal and one across it. Its square is 2 (1 + v.l), so that half of
// its length is v.h.
struct HalfVector {
    double along, across2, length2;
};

inline HalfVector half_vector(const FacetLanes& s, const IncidentLanes& in, size_t i) {
    const double n_dot_l = in.n_dot_l[i];
    const double x = s.v_across.x[i] + (in.direction.x[i] - n_dot_l * s.normal.x[i]);
    const double y = s.v_across.y[i] + (in.direction.y[i] - n_dot_l * s.normal.y[i]);
    const double z = s.v_across.z[i] + (in.direction.z[i] - n_dot_l * s.normal.z[i]);
    const double along = s.n_dot_v[i] + n_dot_l;
    const double across2 = x * x + y * y + z * z;
    return {along, across2, along * along + across2};
}

// (n.h)^exponent. Near the peak, where a large exponent magnifies every rounding, from the sine: log(1 - sin^2) / 2.
double power_lobe(const HalfVector& h, double exponent) {
    const double cosine = h.length2 > 0.0 ? std::max(h.along / std::sqrt(h.length2), kMinFacet) : kMinFacet;
    const double logarithm = cosine > 0.7 ? 0.5 * std::log1p(-h.across2 / h.length2) : std::log(cosine);
    return std::exp(exponent * logarithm);
}

LIGHTSWEEP_CLONES void reflect_lambert(LambertLanes& s, const IncidentLanes& in, double red, double green,
                                       double blue) {
    for (size_t i = 0; i < s.count; ++i) {
        const double irradiance = in.strength[i] * in.n_dot_l[i];
        s.radiance.x[i] += red * irradiance * s.diffuse.x[i];
        s.radiance.y[i] += green * irradiance * s.diffuse.y[i];
        s.radiance.z[i] += blue * irradiance * s.diffuse.z[i];
    }
}

LIGHTSWEEP_CLONES void reflect_ggx(GgxLanes& s, const IncidentLanes& in, double red, double green, double blue) {
    for (size_t i = 0; i < s.count; ++i) {
        const double n_dot_l = in.n_dot_l[i];
        const double alpha2 = s.alpha2[i];
        const HalfVector h = half_vector(s, in, i);
        // Distribution D = a^2 / pi ((n.h)^2 a^2 + |n x h|^2)^2 and visibility V = 1 / 2 (n.l G(v) + n.v G(l)), both
        // with the half vector's length multiplied out, in one division.
        const double spread = h.along * h.along * alpha2 + h.across2;
        const double lit_cosine = std::max(n_dot_l, kMinCosine);
        const double light_masking =
            std::sqrt(lit_cosine * lit_cosine + alpha2 * ((1.0 - lit_cosine) * (1.0 + lit_cosine)));
        const double masking = lit_cosine * s.view_masking[i] + s.visible_cosine[i] * light_masking;
        const double lobe = 0.5 * inv_pi * alpha2 * (h.length2 * h.length2) / (spread * spread * masking);
        const double specular = h.along > 0.0 ? lobe : 0.0;
        // Fresnel F = f0 (1 - m) + m; what it lets through, (1 - f0) (1 - m), feeds the diffuse part.
        const double grazing = 1.0 - 0.5 * std::sqrt(h.length2);
        const double grazing2 = grazing * grazing;
        const double m = grazing2 * grazing2 * grazing;
        const double direct = 1.0 - m;
        const double rim = m * specular;
        const double irradiance = in.strength[i] * n_dot_l;
        s.radiance.x[i] += red * irradiance * (direct * (s.diffuse.x[i] + s.f0.x[i] * specular) + rim);
        s.radiance.y[i] += green * irradiance * (direct * (s.diffuse.y[i] + s.f0.y[i] * specular) + rim);
        s.radiance.z[i] += blue * irradiance * (direct * (s.diffuse.z[i] + s.f0.z[i] * specular) + rim);
    }
}

}  // namespace

size_t SurfaceLanes::add_surface(const ReferenceSurface& s, const glm::dvec3& ambient) {
    CHECK(count < kLanes);
    const size_t lane = count++;
    position.set(lane, s.position);
    normal.set(lane, s.normal);
    radiance.set(lane, s.emissive + ambient * s.base_color);
    return lane;
}

size_t FacetLanes::add_facet(const ReferenceSurface& s, const glm::dvec3& ambient) {
    const size_t lane = add_surface(s, ambient);
    const glm::dvec3 v = -glm::normalize(s.position);
    const double cosine = glm::dot(s.normal, v);
    n_dot_v[lane] = cosine;
    v_across.set(lane, v - cosine * s.normal);
    return lane;
}

void LambertLanes::add(const ReferenceSurface& s, const glm::dvec3& ambient) {
    const size_t lane = add_surface(s, ambient);
    diffuse.set(lane, s.base_color * inv_pi);
}

void BlinnPhongLanes::add(const ReferenceSurface& s, const glm::dvec3& ambient) {
    const size_t lane = add_facet(s, ambient);
    const double alpha2 = squared_alpha(s.roughness);
    exponent[lane] = std::max(2.0 * (1.0 - alpha2) / alpha2, 0.0);
    diffuse.set(lane, s.base_color * inv_pi);
    highlight.set(lane, s.specular * ((0.125 * exponent[lane] + 1.0) * inv_pi));
}

void GgxLanes::add(const ReferenceSurface& s, const glm::dvec3& ambient) {
    const size_t lane = add_facet(s, ambient);
    const glm::dvec3 reflectance = kDielectric * (1.0 - s.metallic) + s.base_color * s.metallic;
    diffuse.set(lane, s.base_color * (1.0 - reflectance) * ((1.0 - s.metallic) * inv_pi));
    f0.set(lane, reflectance);
    const double square = squared_alpha(s.roughness);
    const double cosine = std::max(n_dot_v[lane], kMinCosine);
    alpha2[lane] = square;
    visible_cosine[lane] = cosine;
    view_masking[lane] = std::sqrt(cosine * cosine + square * ((1.0 - cosine) * (1.0 + cosine)));
}

void reflect(LambertLanes& surfaces, const IncidentLanes& incident, const glm::dvec3& color) {
    reflect_lambert(surfaces, incident, color.r, color.g, color.b);
}

void reflect(BlinnPhongLanes& s, const IncidentLanes& in, const glm::dvec3& color) {
    for (size_t i = 0; i < s.count; ++i) {
        const double irradiance = in.strength[i] * in.n_dot_l[i];
        if (irradiance == 0.0) continue;
        const double lobe = power_lobe(half_vector(s, in, i), s.exponent[i]);
        s.radiance.set(i, s.radiance.get(i) + color * irradiance * (s.diffuse.get(i) + s.highlight.get(i) * lobe));
    }
}

void reflect(GgxLanes& surfaces, const IncidentLanes& incident, const glm::dvec3& color) {
    reflect_ggx(surfaces, incident, color.r, color.g, color.b);
}

}  // namespace lightsweep
