// The one shade(). Paths differ in where they call it and how its inputs travel, never in what it does. Lights are
// summed as lobes, and the material weighs the sums once (shorter loops than to weigh each light).
#include "lib/brdf.glsl"
#include "lib/frame.glsl"
#include "lib/guards.glsl"
#include "lib/light.glsl"
#ifdef LIGHT_GRID
#include "lib/light_list.glsl"
#endif

// Zero for a surface at the eye itself.
vec3 view_direction(Surface s) { return unit_or_zero(-s.position); }

#ifdef COMPENSATED_SUMS
// Kahan 1965, "Further Remarks on Reducing Truncation Errors": what an addition rounds off is taken from the next term.
// An addition that overflows has rounded nothing off that could be named.
void add(vec3 term, inout vec3 sum, inout vec3 excess) {
    precise vec3 owed = term - excess;
    precise vec3 next = sum + owed;
    precise vec3 rounding = (next - sum) - owed;
    excess = mix(rounding, vec3(0.0), isinf(next));
    sum = next;
}
#endif

// With COMPENSATED_SUMS the error of a sum does not grow with its length. That is for sums in registers: paths that
// blend one light after another add in the target's format, which holds no remainder.
void add_light(Surface s, vec3 v, Incident incident, inout LobeSums sums) {
    Lobes lobes = light_lobes(s.normal, s.roughness, s.model, v, incident.direction);
#ifdef COMPENSATED_SUMS
    add(incident.irradiance * lobes.diffuse, sums.diffuse, sums.diffuse_excess);
    add(incident.irradiance * lobes.f0, sums.f0, sums.f0_excess);
    add(incident.irradiance * lobes.f90, sums.f90, sums.f90_excess);
#else
    sums.diffuse += incident.irradiance * lobes.diffuse;
    sums.f0 += incident.irradiance * lobes.f0;
    sums.f90 += incident.irradiance * lobes.f90;
#endif
}

// One point or spot light. Nothing is computed where it does not reach.
void add_local(Surface s, vec3 v, LightData light, inout LobeSums sums) {
    if (reaches(light, s.position)) add_light(s, v, local_light(light, s.position), sums);
}

void add_directional(Surface s, vec3 v, inout LobeSums sums) {
#ifdef HAS_DIRECTIONAL_LIGHTS
    for (uint i = 0u; i < frame.directional_count; ++i) add_light(s, v, directional_light(light_at(i)), sums);
#endif
}

// With LIGHT_GRID, the lights that are listed for the pixel's cell; else every light. Of the surface, base colour,
// metallic, specular and emission do not matter.
LobeSums sum_lights(Surface s) {
    vec3 v = view_direction(s);
    LobeSums sums = kNoLight;
    add_directional(s, v, sums);
#ifdef LIGHT_GRID
    LightList list = light_list(gl_FragCoord.xy, dot(s.position, frame.ray_forward));
    for (uint i = list.begin; i < list.end; ++i) add_local(s, v, light_at(listed_light(i)), sums);
#else
    for (uint i = frame.directional_count; i < frame.light_count; ++i) add_local(s, v, light_at(i), sums);
#endif
    return sums;
}

// What leaves the surface when these lights fall on it: emission, ambient, reflection.
vec3 shade_lit(Surface s, LobeSums lights) {
    return s.emissive + frame.ambient * s.base_color + reflect_lobes(s, lights);
}

vec3 shade(Surface s) { return shade_lit(s, sum_lights(s)); }

// The two halves of shade(), for paths that draw for each light. Everything that no single place owns:
vec3 shade_base(Surface s) {
    LobeSums sums = kNoLight;
    add_directional(s, view_direction(s), sums);
    return shade_lit(s, sums);
}

// and one point or spot light.
vec3 shade_local(Surface s, LightData light) {
    LobeSums sums = kNoLight;
    add_local(s, view_direction(s), light, sums);
    return reflect_lobes(s, sums);
}
