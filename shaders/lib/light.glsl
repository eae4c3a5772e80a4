// One light at one point: where it comes from and how much arrives. Every path calls this.
#include "lib/guards.glsl"
#include "shared/slots.h"
#include "shared/types.h"

layout(binding = kLightUnit) uniform samplerBuffer light_texels;

LightData light_at(uint index) {
    int first = int(index) * 3;
    vec4 place = texelFetch(light_texels, first);
    vec4 color = texelFetch(light_texels, first + 1);
    vec4 cone = texelFetch(light_texels, first + 2);
    return LightData(place.xyz, place.w, color.xyz, color.w, cone.xyz, cone.w);
}

struct Incident {
    vec3 direction;   // unit, from the surface to the light
    vec3 irradiance;  // on a surface that faces the light
};

// Below this distance (in scene units) a point light stops growing: the inverse square has no bound.
const float kMinDistanceSquared = 1e-4;

Incident directional_light(LightData light) { return Incident(-light.direction, light.color); }

// Inverse square times a window that is exactly zero at the radius (Karis 2013, "Real Shading in Unreal Engine 4",
// with the smooth window squared), so that culling at the radius loses nothing. Of a point at the light, no direction:
// zero, which no surface faces. The radius is one whose square is a finite number above 0 (collect_lights).
Incident local_light(LightData light, vec3 position) {
    vec3 to_light = light.position - position;
    float distance_squared = dot(to_light, to_light);
    float inverse_distance = inversesqrt(GUARDED(max(distance_squared, 1e-20), distance_squared));
    vec3 direction = to_light * inverse_distance;
    float ratio = distance_squared / (light.radius * light.radius);
    float window = max(1.0 - ratio * ratio, 0.0);
    // One factor for all channels: a capped light keeps its hue.
    float attenuation = window * window / GUARDED(max(distance_squared, kMinDistanceSquared), distance_squared);
#ifdef HAS_SPOT_LIGHTS
    float spot = clamp(dot(-direction, light.direction) * light.spot_scale + light.spot_offset, 0.0, 1.0);
    attenuation *= spot * spot;
#endif
    return Incident(direction, light.color * attenuation);
}

bool reaches(LightData light, vec3 position) {
    vec3 to_light = light.position - position;
    return dot(to_light, to_light) < light.radius * light.radius;
}
