// Between world axes and the viewer's: x to the right, y up, z towards the viewer.
#include "lib/frame.glsl"

// ray_right and ray_up are as long as the view is wide and high.
vec3 view_right() { return normalize(frame.ray_right); }
vec3 view_up() { return normalize(frame.ray_up); }

vec3 view_from_world(vec3 v) { return vec3(dot(view_right(), v), dot(view_up(), v), -dot(frame.ray_forward, v)); }
vec3 world_from_view(vec3 v) { return v.x * view_right() + v.y * view_up() - v.z * frame.ray_forward; }
