// Visibility buffer, second half, for the pixels of one material: rebuild the surface and shade it with every light.
#include "lib/visible_surface.glsl"
#include "lib/shade.glsl"

// Before the shader: the stencil keeps other materials' pixels from running it at all.
layout(early_fragment_tests) in;

layout(binding = kTargetUnit) uniform usampler2D visible_triangles;
layout(location = 0) out vec4 color;

void main() {
    uvec2 visible = texelFetch(visible_triangles, ivec2(gl_FragCoord.xy), 0).xy;
    uint instance = visible.x - 1u;
    InstanceMesh mesh = instance_mesh_at(instance);
    // The stencil has fewer numbers than a scene may have materials.
    if (mesh.material != material.id) discard;
    color = vec4(shade(visible_surface(gl_FragCoord.xy, instance, visible.y, mesh)), 1.0);
}
