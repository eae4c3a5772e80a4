// The one shade(). Paths differ in where they call it and how its inputs travel, never in what it does.
#include "lib/brdf.glsl"
#include "lib/frame.glsl"
#include "lib/light.glsl"

vec3 view_direction(Surface s) { return normalize(-s.position); }

// One point or spot light. Nothing is computed where it does not reach.
vec3 shade_local(Surface s, vec3 v, LightData light) {
    if (!reaches(light, s.position)) return vec3(0.0);
    Incident incident = local_light(light, s.position);
    return incident.irradiance * reflect_light(s, v, incident.direction);
}

// Everything that no single place owns: emission, ambient, directional lights.
vec3 shade_base(Surface s, vec3 v) {
    vec3 color = s.emissive + frame.ambient * s.base_color;
#ifdef HAS_DIRECTIONAL_LIGHTS
    for (uint i = 0u; i < frame.directional_count; ++i) {
        Incident incident = directional_light(lights[i]);
        color += incident.irradiance * reflect_light(s, v, incident.direction);
    }
#endif
    return color;
}

vec3 shade(Surface s) {
    vec3 v = view_direction(s);
    vec3 color = shade_base(s, v);
    for (uint i = frame.directional_count; i < frame.light_count; ++i) color += shade_local(s, v, lights[i]);
    return color;
}
