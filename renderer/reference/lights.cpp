#include "renderer/reference/lights.h"

#include "renderer/reference/clones.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

// A point light stops growing at a hundredth of a unit: the inverse square has no bound.
constexpr double kMaxInverseSquare = 1e4;
constexpr double kMinConeWidth = 1e-4;  // in cosines
constexpr double kMaxInverseDistance = 1e10;

double square_length(double x, double y, double z) { return x * x + y * y + z * z; }

// cos(a) - cos(b) in degrees, without cancellation when they are close.
double cosine_difference(double a, double b) {
    return 2.0 * std::sin(0.5 * glm::radians(a + b)) * std::sin(0.5 * glm::radians(b - a));
}

// How far outside of [low, high].
double outside(double at, double low, double high) { return std::max({low - at, at - high, 0.0}); }

// Inverse square times a window that is exactly zero at the radius: (1 - (d/r)^4)^2, with the difference of squares
// factored (after Karis 2013, "Real Shading in Unreal Engine 4"). The point's squared distance is computed with the
// same operations in the same order as a box's in lights_reaching; each of them is monotone, rounding included, so
// that a box that holds the point is never found farther away than the point.
LIGHTSWEEP_CLONES void light_from_place(const PlacedLight& light, const SurfaceLanes& s, IncidentLanes& in) {
    const double px = light.position.x, py = light.position.y, pz = light.position.z;
    const double radius2 = light.radius2;
    const double inverse_radius2 = 1.0 / radius2;
    for (size_t i = 0; i < s.count; ++i) {
        const double x = px - s.position.x[i], y = py - s.position.y[i], z = pz - s.position.z[i];
        const double distance2 = x * x + y * y + z * z;
        const double unbounded = 1.0 / std::sqrt(distance2);
        const double inverse = unbounded < kMaxInverseDistance ? unbounded : kMaxInverseDistance;
        const double dx = x * inverse, dy = y * inverse, dz = z * inverse;
        const double n_dot_l = s.normal.x[i] * dx + s.normal.y[i] * dy + s.normal.z[i] * dz;
        const double inside = (radius2 - distance2) * inverse_radius2;
        const double window = (inside > 0.0 ? inside : 0.0) * ((radius2 + distance2) * inverse_radius2);
        const double inverse2 = inverse * inverse;
        in.direction.x[i] = dx;
        in.direction.y[i] = dy;
        in.direction.z[i] = dz;
        in.n_dot_l[i] = n_dot_l > 0.0 ? n_dot_l : 0.0;
        in.strength[i] = window * window * (inverse2 < kMaxInverseSquare ? inverse2 : kMaxInverseSquare);
    }
}

// Full inside the inner cone, zero outside the outer one, the cosine's share squared between them (glTF 2.0,
// KHR_lights_punctual).
LIGHTSWEEP_CLONES void narrow_to_cone(const PlacedLight& light, size_t count, IncidentLanes& in) {
    const double ax = light.direction.x, ay = light.direction.y, az = light.direction.z;
    const double cos_outer = light.cos_outer, scale = light.cone_scale;
    for (size_t i = 0; i < count; ++i) {
        const double cosine = -(in.direction.x[i] * ax + in.direction.y[i] * ay + in.direction.z[i] * az);
        const double share = (cosine - cos_outer) * scale;
        const double at_least = share > 0.0 ? share : 0.0;
        const double clamped = at_least < 1.0 ? at_least : 1.0;
        in.strength[i] *= clamped * clamped;
    }
}

LIGHTSWEEP_CLONES void light_from_direction(const PlacedLight& light, const SurfaceLanes& s, IncidentLanes& in) {
    const double dx = -light.direction.x, dy = -light.direction.y, dz = -light.direction.z;
    for (size_t i = 0; i < s.count; ++i) {
        const double n_dot_l = s.normal.x[i] * dx + s.normal.y[i] * dy + s.normal.z[i] * dz;
        in.direction.x[i] = dx;
        in.direction.y[i] = dy;
        in.direction.z[i] = dz;
        in.n_dot_l[i] = n_dot_l > 0.0 ? n_dot_l : 0.0;
        in.strength[i] = 1.0;
    }
}

}  // namespace

std::vector<PlacedLight> place_lights(std::span<const Light> lights, const glm::dvec3& eye) {
    std::vector<PlacedLight> placed;
    placed.reserve(lights.size());
    for (const Light& light : lights) {
        if (light.color == glm::dvec3(0.0)) continue;
        if (light.kind != LightKind::directional && !(light.radius > 0.0)) continue;
        const double cone_width = cosine_difference(light.inner_deg, light.outer_deg);
        placed.push_back({.kind = light.kind,
                          .position = light.position - eye,
                          .direction = light.direction,
                          .color = light.color,
                          .radius2 = light.radius * light.radius,
                          .cos_outer = std::cos(glm::radians(light.outer_deg)),
                          .cone_scale = 1.0 / std::max(cone_width, kMinConeWidth)});
    }
    return placed;
}

void lights_reaching(std::span<const PlacedLight> lights, std::span<const uint32_t> candidates, const Bounds& box,
                     std::vector<uint32_t>& reaching) {
    reaching.clear();
    for (const uint32_t index : candidates) {
        const PlacedLight& light = lights[index];
        const glm::dvec3& p = light.position;
        const double distance2 = square_length(outside(p.x, box.low.x, box.high.x), outside(p.y, box.low.y, box.high.y),
                                               outside(p.z, box.low.z, box.high.z));
        if (light.kind == LightKind::directional || distance2 < light.radius2) reaching.push_back(index);
    }
}

void light_lanes(const PlacedLight& light, const SurfaceLanes& surfaces, IncidentLanes& incident) {
    if (light.kind == LightKind::directional) {
        light_from_direction(light, surfaces, incident);
        return;
    }
    light_from_place(light, surfaces, incident);
    if (light.kind == LightKind::spot) narrow_to_cone(light, surfaces.count, incident);
}

}  // namespace lightsweep
