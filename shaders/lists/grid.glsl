// What the list builder's kernels have in common: the grid, and what the lights reach.
#include "lib/frame.glsl"
#include "shared/slots.h"
#include "shared/types.h"
#include "shared/light_cell.h"
#include "shared/light_masks.h"

layout(std140, binding = kLightGridBlock) uniform LightGridBlock { LightGridData light_grid; };
layout(binding = kLightBoundsUnit) uniform samplerBuffer bounds_texels;

// Point and spot lights; number 0 is light frame.directional_count.
uint bounds_count() { return frame.light_count - frame.directional_count; }

vec4 bounding_sphere(uint number) { return texelFetch(bounds_texels, int(number) * 3); }

LightBounds bounds_at(uint number) {
    int first = int(number) * 3;
    vec4 sphere = texelFetch(bounds_texels, first);
    vec4 apex = texelFetch(bounds_texels, first + 1);
    vec4 cone = texelFetch(bounds_texels, first + 2);
    return LightBounds(sphere.xyz, sphere.w, apex.xyz, apex.w, cone.xyz, cone.w);
}
