// forward_multipass: adds one light; the material is evaluated again for each.
#include "lib/mesh_surface.glsl"
#include "lib/shade.glsl"

layout(location = kLightIndexUniform) uniform uint light_index;
layout(location = 0) out vec4 color;

void main() { color = vec4(shade_local(mesh_surface(), light_at(light_index)), 0.0); }
