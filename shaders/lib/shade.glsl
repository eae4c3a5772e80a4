// The one shade(). Paths differ in where they call it and how its inputs travel, never in what it does.
#include "lib/brdf.glsl"
#include "lib/frame.glsl"
#include "lib/light.glsl"
#ifdef LIGHT_GRID
#include "lib/light_list.glsl"
#endif

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
        Incident incident = directional_light(light_at(i));
        color += incident.irradiance * reflect_light(s, v, incident.direction);
    }
#endif
    return color;
}

// With LIGHT_GRID, the lights that are listed for the pixel's cell; else every light.
vec3 shade(Surface s) {
    vec3 v = view_direction(s);
    vec3 color = shade_base(s, v);
#ifdef LIGHT_GRID
    LightList list = light_list(gl_FragCoord.xy, dot(s.position, frame.ray_forward));
    for (uint i = list.begin; i < list.end; ++i) color += shade_local(s, v, light_at(listed_light(i)));
#else
    for (uint i = frame.directional_count; i < frame.light_count; ++i) color += shade_local(s, v, light_at(i));
#endif
    return color;
}
