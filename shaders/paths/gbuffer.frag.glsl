// Deferred, first half: evaluate the material and store it as the layout says.
#include "lib/mesh_surface.glsl"
#define GBUFFER_WRITE
#include "generated/gbuffer.glsl"

void main() { write_surface(mesh_surface()); }
