// Every pass that draws meshes. DEPTH_ONLY: position (and texture coordinates where a mask needs them) alone.
// OUTPUT_INSTANCE: which instance it is, too.
#include "lib/frame.glsl"

layout(binding = kInstanceUnit) uniform samplerBuffer instance_texels;

InstanceData instance_at(uint index) {
    int first = int(index) * 6;
    return InstanceData(texelFetch(instance_texels, first), texelFetch(instance_texels, first + 1),
                        texelFetch(instance_texels, first + 2), texelFetch(instance_texels, first + 3),
                        texelFetch(instance_texels, first + 4), texelFetch(instance_texels, first + 5));
}

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
    // Both differences are of nearby numbers: exact, or nearly so, however far from the origin the camera is.
    vec3 translation = (vec3(i.axis_x.w, i.axis_y.w, i.axis_z.w) - frame.camera_high) +
                       (vec3(i.normal_x.w, i.normal_y.w, i.normal_z.w) - frame.camera_low);
    vec3 rotated = i.axis_x.xyz * position.x + i.axis_y.xyz * position.y + i.axis_z.xyz * position.z;
    vec3 world = rotated + translation;
    gl_Position = frame.clip_from_world * vec4(world, 1.0);
    out_texcoord = texcoord;
#ifdef OUTPUT_INSTANCE
    out_instance = instance_index;
#endif
#ifndef DEPTH_ONLY
    out_position = world;
    out_normal = normalize(i.normal_x.xyz * normal.x + i.normal_y.xyz * normal.y + i.normal_z.xyz * normal.z);
#ifdef HAS_NORMAL_TEXTURE
    vec3 along = i.axis_x.xyz * tangent.x + i.axis_y.xyz * tangent.y + i.axis_z.xyz * tangent.z;
    // A mirrored instance turns the bitangent round with it.
    float mirror = dot(cross(i.axis_x.xyz, i.axis_y.xyz), i.axis_z.xyz) < 0.0 ? -1.0 : 1.0;
    out_tangent = vec4(dot(along, along) > 0.0 ? normalize(along) : vec3(1.0, 0.0, 0.0), tangent.w * mirror);
#endif
#endif
}
