// Where the meshes of renderer/pass/volume_meshes.h are to enclose what a light reaches: a sphere for a point light, a
// cone with a cap for a spot. The meshes enclose the round shapes, so that their flat faces cut nothing off.
// POSITION_ERROR: of the layout, relative to the distance. DEPTH_STEP: of the depth target; 0 where that is relative
// too.
#include "lib/frame.glsl"
#include "lib/light.glsl"

// Of the arithmetic here, in the rasteriser and in shading.
const float kRounding = 2e-6;
const float kCosRounding = 1e-6;

// How far the surface that shading sees may be from where the depth test sees it, for all that the light reaches.
float surface_error(LightData light) {
    float farthest = length(light.position) + light.radius;
    return farthest * (POSITION_ERROR + kRounding + farthest * (DEPTH_STEP / abs(frame.depth_scale)));
}

// Distances along and off the axis, of a level of the mesh, that enclose the unit cone with a spherical cap and the
// half angle a: its side runs to the cap's rim (cos a, sin a); there the plane that touches the cap turns inwards, at
// right angles to the side, and meets the plane that touches the top at (1, tan(a / 2)). A prism at 90 degrees.
vec2 cone_profile(float level, float cos_a, float sin_a) {
    if (level == 0.0) return vec2(0.0);
    return level == 1.0 ? vec2(cos_a, sin_a) : vec2(1.0, sin_a / (1.0 + cos_a));
}

vec3 sphere_point(LightData light, float error, vec3 vertex) {
    return light.position + (light.radius + error) * vertex;
}

vec3 cone_point(LightData light, float error, vec3 vertex) {
    float cos_a = clamp(-light.spot_offset / light.spot_scale - kCosRounding, 0.0, 1.0);
    float sin_a = sqrt((1.0 - cos_a) * (1.0 + cos_a));
    // All points within `error` of a cone are in the same cone with its apex drawn back.
    float back = error / sin_a;
    vec2 profile = (light.radius + error + back) * cone_profile(vertex.z, cos_a, sin_a);
    vec3 axis = light.direction;
    vec3 right = normalize(cross(abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), axis));
    vec3 up = cross(axis, right);
    return light.position + (profile.x - back) * axis + profile.y * (vertex.x * right + vertex.y * up);
}

// Camera-relative, of a vertex of the mesh for this light.
vec3 volume_point(LightData light, vec3 vertex) {
    float error = surface_error(light);
    return light.spot_scale > 0.0 ? cone_point(light, error, vertex) : sphere_point(light, error, vertex);
}
