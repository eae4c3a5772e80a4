// Every pass that draws meshes. DEPTH_ONLY: position (and texture coordinates where a mask needs them) alone.
// OUTPUT_INSTANCE: which instance it is, too.
#include "lib/instance.glsl"

layout(location = kPositionAttribute) in vec3 position;
layout(location = kNormalAttribute) in vec3 normal;
layout(location = kTangentAttribute) in vec4 tangent;
layout(location = kTexcoordAttribute) in vec2 texcoord;
layout(location = kInstanceAttribute) in uint instance_index;

// The depth prepass and the pass that tests for equality must compute the same bits.
invariant gl_Position;

layout(location = 0) out vec2 out_texcoord;
#ifndef DEPTH_ONLY
layout(location = 1) out vec3 out_position;
layout(location = 2) out vec3 out_normal;
#ifdef HAS_NORMAL_TEXTURE
layout(location = 3) out vec4 out_tangent;
#endif
#endif

#ifdef OUTPUT_INSTANCE
layout(location = 4) flat out uint out_instance;
#endif

void main() {
    InstanceData i = instance_at(instance_index);
    vec3 world = to_world(i, position) + instance_origin(i);
    gl_Position = frame.clip_from_world * vec4(world, 1.0);
    out_texcoord = texcoord;
#ifdef OUTPUT_INSTANCE
    out_instance = instance_index;
#endif
#ifndef DEPTH_ONLY
    out_position = world;
    out_normal = world_normal(i, normal);
#ifdef HAS_NORMAL_TEXTURE
    out_tangent = world_tangent(i, tangent);
#endif
#endif
}
