// The fragment side of mesh.vert.glsl: its outputs as a Surface.
#include "lib/material.glsl"

layout(location = 0) in vec2 in_texcoord;
layout(location = 1) in vec3 in_position;
layout(location = 2) in vec3 in_normal;
#ifdef HAS_NORMAL_TEXTURE
layout(location = 3) in vec4 in_tangent;
#else
const vec4 in_tangent = vec4(0.0);
#endif

Surface mesh_surface() {
    discard_unseen(in_texcoord);
    return evaluate_material(in_position, in_normal, in_tangent, in_texcoord, gl_FrontFacing);
}
