// Pixels side by side, so that one instruction shades several: the surfaces of a small tile, sorted by shading model,
// and the light that falls on them. Double precision; each lane computes as if it were alone. Knows no scene.
#pragma once

#include "renderer/reference/surfaces.h"

#include <array>
#include <cstddef>

namespace lightsweep {

inline constexpr size_t kLanes = 64;  ///< an 8x8 tile: what a model's lanes need then stays in the first-level cache

struct alignas(64) Lane {
    std::array<double, kLanes> values;
    double& operator[](size_t i) { return values[i]; }
    double operator[](size_t i) const { return values[i]; }
};

struct Lane3 {
    Lane x, y, z;
    void set(size_t i, const glm::dvec3& v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    glm::dvec3 get(size_t i) const { return {x[i], y[i], z[i]}; }
};

/// What every model needs: where the lanes' surfaces are, and what they have been given so far.
struct SurfaceLanes {
    size_t count = 0;
    Lane3 position;  ///< relative to the eye
    Lane3 normal;
    Lane3 radiance;  ///< towards the eye; starts as emission and ambient light

    /// Returns the new lane.
    size_t add_surface(const ReferenceSurface& s, const glm::dvec3& ambient);
};

/// Models with a highlight: the direction to the eye as a part along the normal and a part across it, so that the half
/// vector's angle to the normal is known without cancellation.
struct FacetLanes : SurfaceLanes {
    Lane n_dot_v;
    Lane3 v_across;

    size_t add_facet(const ReferenceSurface& s, const glm::dvec3& ambient);
};

struct LambertLanes : SurfaceLanes {
    Lane3 diffuse;
    void add(const ReferenceSurface& s, const glm::dvec3& ambient);
};

struct BlinnPhongLanes : FacetLanes {
    Lane3 diffuse, highlight;
    Lane exponent;
    void add(const ReferenceSurface& s, const glm::dvec3& ambient);
};

struct GgxLanes : FacetLanes {
    Lane3 diffuse;        ///< below a surface seen straight on
    Lane3 f0;             ///< reflectance there
    Lane alpha2;          ///< alpha squared
    Lane visible_cosine;  ///< n.v for the masking term, kept above zero
    Lane view_masking;    ///< sqrt((n.v)^2 + alpha^2 (1 - (n.v)^2))
    void add(const ReferenceSurface& s, const glm::dvec3& ambient);
};

/// One light at each lane.
struct IncidentLanes {
    Lane3 direction;  ///< unit, to the light
    Lane n_dot_l;     ///< 0 where the light is behind the surface
    Lane strength;    ///< irradiance on a surface that faces the light, per unit of the light's colour
};

/// Adds what the lanes' surfaces reflect of the light to their radiance. `color`: of the light.
void reflect(LambertLanes& surfaces, const IncidentLanes& incident, const glm::dvec3& color);
void reflect(BlinnPhongLanes& surfaces, const IncidentLanes& incident, const glm::dvec3& color);
void reflect(GgxLanes& surfaces, const IncidentLanes& incident, const glm::dvec3& color);

}  // namespace lightsweep
