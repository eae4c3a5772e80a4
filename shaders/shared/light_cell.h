// Which cells of the light grid a light touches: one text for the CPU's list builder and the compute shader's, so that
// both make the same lists. Only what GLSL and C++ read alike; GLSL includes shared/types.h before.
//
// The bounds of lights are grown by 2^-12 of their distance and more (light_bounds.h): a thousand times what rounding
// takes here, so that nothing below rounds outwards.
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
    // In this order, max takes the number where z is none.
    float slice = floor(log2(max(1e-20F, z)) * grid.slice_scale + grid.slice_offset);
    return uint(clamp(slice, 0.0F, float(grid.slices - 1U)));
}

// The view distance at which slice `slice` begins; 0 for the first. No light reaches a surface beyond
// slice_begin(grid, grid.slices), where the last slice ends.
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

LIGHTSWEEP_INLINE float distance_outside(float value, float low, float high) {
    return max(max(low - value, value - high), 0.0F);
}

// How far `across` is from what lies between two slopes and two view distances, seen along the view.
LIGHTSWEEP_INLINE float distance_across(float across, float slope_low, float slope_high, float z_low, float z_high) {
    return distance_outside(across, min(slope_low * z_low, slope_low * z_high),
                            max(slope_high * z_low, slope_high * z_high));
}

// The lowest and the highest slope across / z in the part of a disc around (across, z) with z_low <= z <= z_high (after
// Mara and McGuire 2013, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere"). The slope along the
// disc's edge has one extremum on either side: where the line from the eye is tangent, or, when that is not in the
// part, at the end next to it. An eye inside the disc has no tangent and sees the extrema at the near end.
LIGHTSWEEP_INLINE vec2 disc_slopes(float across, float z, float radius_squared, float z_low, float z_high) {
    float radius = sqrt(radius_squared);
    float begin = max(z_low, z - radius), end = min(z_high, z + radius);
    float distance_squared = across * across + z * z;
    float tangent = sqrt(max(distance_squared - radius_squared, 0.0F));
    float scale = tangent / max(distance_squared, 1e-20F);
    float z_lowest = min(max((z * tangent + across * radius) * scale, begin), end);
    float z_highest = min(max((z * tangent - across * radius) * scale, begin), end);
    float chord_lowest = sqrt(max(radius_squared - (z_lowest - z) * (z_lowest - z), 0.0F));
    float chord_highest = sqrt(max(radius_squared - (z_highest - z) * (z_highest - z), 0.0F));
    return vec2((across - chord_lowest) / max(z_lowest, 1e-20F), (across + chord_highest) / max(z_highest, 1e-20F));
}

// The least dot(direction, p) of the cell's points p.
LIGHTSWEEP_INLINE float least_along(CellBounds cell, vec3 direction) {
    float per_z = min(direction.x * cell.slopes.x, direction.x * cell.slopes.z) +
                  min(direction.y * cell.slopes.y, direction.y * cell.slopes.w) + direction.z;
    return min(per_z * cell.z_low, per_z * cell.z_high);
}

// Whether a spot touches a cell: not when its range ends before, nor when a plane has the cell on one side and the cone
// on the other. Two planes are tried: across the axis through the apex, and along the cone's side that faces the middle
// of the cell. One comparison, so that loops over cells become vector code.
LIGHTSWEEP_INLINE bool cone_touches_cell(LightBounds light, CellBounds cell) {
    float beside_x = distance_across(light.apex.x, cell.slopes.x, cell.slopes.z, cell.z_low, cell.z_high);
    float beside_y = distance_across(light.apex.y, cell.slopes.y, cell.slopes.w, cell.z_low, cell.z_high);
    float beside_z = distance_outside(light.apex.z, cell.z_low, cell.z_high);
    float beyond_range =
        beside_x * beside_x + beside_y * beside_y + beside_z * beside_z - light.range * light.range;
    float behind_apex = dot(light.axis, light.apex) + least_along(cell, -light.axis);
    float middle_z = 0.5F * (cell.z_low + cell.z_high);
    vec3 to_middle = vec3(0.5F * (cell.slopes.x + cell.slopes.z) * middle_z,
                          0.5F * (cell.slopes.y + cell.slopes.w) * middle_z, middle_z) - light.apex;
    vec3 across = to_middle - dot(to_middle, light.axis) * light.axis;
    float sin_half_angle = sqrt(max(1.0F - light.cos_half_angle * light.cos_half_angle, 0.0F));
    vec3 outwards = across * (light.cos_half_angle / max(length(across), 1e-20F)) - sin_half_angle * light.axis;
    float beside_cone = least_along(cell, outwards) - dot(outwards, light.apex);
    return max(max(beyond_range, behind_apex), beside_cone) <= 0.0F;
}

// Never false for a cell that holds a point which the light reaches. The light's sphere is cut by the cell's view
// distances, then by its rows: what is left is held against its columns.
LIGHTSWEEP_INLINE bool light_touches_cell(LightBounds light, CellBounds cell) {
    float radius_squared = light.radius * light.radius;
    cell.z_low = max(cell.z_low, light.center.z - light.radius);
    cell.z_high = min(cell.z_high, light.center.z + light.radius);
    if (cell.z_low > cell.z_high) return false;
    vec2 rows = disc_slopes(light.center.y, light.center.z, radius_squared, cell.z_low, cell.z_high);
    if (rows.x > cell.slopes.w || rows.y < cell.slopes.y) return false;
    float beside_y = distance_across(light.center.y, cell.slopes.y, cell.slopes.w, cell.z_low, cell.z_high);
    float beside_z = distance_outside(light.center.z, cell.z_low, cell.z_high);
    float row_radius_squared = radius_squared - beside_y * beside_y;
    if (beside_z * beside_z > row_radius_squared) return false;
    vec2 columns = disc_slopes(light.center.x, light.center.z, row_radius_squared, cell.z_low, cell.z_high);
    if (columns.x > cell.slopes.z || columns.y < cell.slopes.x) return false;
    if (light.cos_half_angle <= 0.0F) return true;
    return cone_touches_cell(light, cell);
}

#ifdef __cplusplus
}  // namespace lightsweep::shared
#endif
#undef LIGHTSWEEP_INLINE
