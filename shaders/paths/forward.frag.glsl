// Forward: evaluate the material and shade it with every light, in one go.
#include "lib/mesh_surface.glsl"
#include "lib/shade.glsl"

layout(location = 0) out vec4 color;

void main() { color = vec4(shade(mesh_surface()), 1.0); }
