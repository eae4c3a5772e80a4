// Which cells of the light grid a light touches: one text for the CPU's list builder and the compute shader's, so that
// both make the same lists. Only what GLSL and C++ read alike; GLSL includes shared/types.h before.
#ifdef __cplusplus
#pragma once
#include <shaders/shared/types.h>

#include <glm/glm.hpp>
namespace lightsweep::shared {
using glm::clamp;
using glm::dot;
using glm::exp2;
using glm::floor;
using glm::length;
using glm::log2;
using glm::max;
using glm::min;
using glm::sqrt;
#define LIGHTSWEEP_INLINE inline
#else
#define LIGHTSWEEP_INLINE
#endif

// A cell: between slopes across the view (x / z and y / z), and between two view distances.
struct CellBounds {
    vec4 slopes;  // lowest x, lowest y, highest x, highest y
    float z_low;
    float z_high;
};

LIGHTSWEEP_INLINE uint slice_of(LightGridData grid, float z) {
    float slice = floor(log2(max(z, 1e-20F)) * grid.slice_scale + grid.slice_offset);
    return uint(clamp(slice, 0.0F, float(grid.slices - 1U)));
}

// The view distance at which slice `slice` begins; 0 for the first.
LIGHTSWEEP_INLINE float slice_begin(LightGridData grid, uint slice) {
    return slice == 0U ? 0.0F : exp2((float(slice) - grid.slice_offset) / grid.slice_scale);
}

// `z_low` and `z_high`: of the slice, or of the surfaces that the tile shows.
LIGHTSWEEP_INLINE CellBounds cell_bounds(LightGridData grid, uint tile_x, uint tile_y, float z_low, float z_high) {
    float left = float(tile_x * grid.tile_px), bottom = float(tile_y * grid.tile_px), edge = float(grid.tile_px);
    CellBounds cell;
    cell.slopes = vec4(left * grid.tangent_per_px_x - grid.tan_x, bottom * grid.tangent_per_px_y - grid.tan_y,
                       (left + edge) * grid.tangent_per_px_x - grid.tan_x,
                       (bottom + edge) * grid.tangent_per_px_y - grid.tan_y);
    cell.z_low = z_low;
    cell.z_high = z_high;
    return cell;
}

LIGHTSWEEP_INLINE vec3 cell_low(CellBounds cell) {
    return vec3(min(cell.slopes.x * cell.z_low, cell.slopes.x * cell.z_high),
                min(cell.slopes.y * cell.z_low, cell.slopes.y * cell.z_high), cell.z_low);
}

LIGHTSWEEP_INLINE vec3 cell_high(CellBounds cell) {
    return vec3(max(cell.slopes.z * cell.z_low, cell.slopes.z * cell.z_high),
                max(cell.slopes.w * cell.z_low, cell.slopes.w * cell.z_high), cell.z_high);
}

LIGHTSWEEP_INLINE bool sphere_touches_box(vec3 center, float radius, vec3 low, vec3 high) {
    vec3 beyond = max(max(low - center, center - high), vec3(0.0F));
    return dot(beyond, beyond) <= radius * radius;
}

// Whether a sphere is not wholly beyond the plane through the eye whose points have the slope `slope`; `across` is the
// centre's x or y, positive beyond the plane after `side` (1 or -1).
LIGHTSWEEP_INLINE bool sphere_touches_side(float across, float z, float radius, float slope, float side) {
    float beyond = side * (across - slope * z);
    return beyond <= 0.0F || beyond * beyond <= radius * radius * (1.0F + slope * slope);
}

// Of the six planes, near and far are the box's own.
LIGHTSWEEP_INLINE bool sphere_touches_sides(vec3 center, float radius, vec4 slopes) {
    return sphere_touches_side(center.x, center.z, radius, slopes.x, -1.0F) &&
           sphere_touches_side(center.y, center.z, radius, slopes.y, -1.0F) &&
           sphere_touches_side(center.x, center.z, radius, slopes.z, 1.0F) &&
           sphere_touches_side(center.y, center.z, radius, slopes.w, 1.0F);
}

// Whether a cone (half angle below 90 degrees) touches a sphere (Wronski 2017, "Cull that cone!").
LIGHTSWEEP_INLINE bool cone_touches_sphere(vec3 apex, vec3 axis, float range, float cos_half_angle, vec3 center,
                                           float radius) {
    vec3 to_center = center - apex;
    float along = dot(to_center, axis);
    float across = sqrt(max(dot(to_center, to_center) - along * along, 0.0F));
    float sin_half_angle = sqrt(max(1.0F - cos_half_angle * cos_half_angle, 0.0F));
    bool beside = cos_half_angle * across - sin_half_angle * along > radius;
    return !beside && along <= radius + range && along >= -radius;
}

// Never false for a cell that holds a point which the light reaches.
LIGHTSWEEP_INLINE bool light_touches_cell(LightBounds light, CellBounds cell) {
    vec3 low = cell_low(cell);
    vec3 high = cell_high(cell);
    if (!sphere_touches_box(light.center, light.radius, low, high)) return false;
    if (!sphere_touches_sides(light.center, light.radius, cell.slopes)) return false;
    if (light.cos_half_angle <= 0.0F) return true;
    return sphere_touches_box(light.apex, light.range, low, high) &&
           cone_touches_sphere(light.apex, light.axis, light.range, light.cos_half_angle, 0.5F * (low + high),
                               0.5F * length(high - low));
}

#ifdef __cplusplus
}  // namespace lightsweep::shared
#endif
#undef LIGHTSWEEP_INLINE
