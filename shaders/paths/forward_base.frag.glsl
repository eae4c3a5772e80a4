// forward_multipass: what no single light adds (emission, ambient, directional lights).
#include "lib/mesh_surface.glsl"
#include "lib/shade.glsl"

layout(location = 0) out vec4 color;

void main() { color = vec4(shade_base(mesh_surface()), 1.0); }
