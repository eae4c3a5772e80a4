// An instance's transform, for the vertex shader and for passes that fetch vertices themselves.
#include "lib/frame.glsl"

layout(binding = kInstanceUnit) uniform samplerBuffer instance_texels;

InstanceData instance_at(uint index) {
    int first = int(index) * 6;
    return InstanceData(texelFetch(instance_texels, first), texelFetch(instance_texels, first + 1),
                        texelFetch(instance_texels, first + 2), texelFetch(instance_texels, first + 3),
                        texelFetch(instance_texels, first + 4), texelFetch(instance_texels, first + 5));
}

// From the camera to the mesh's origin. Both differences are of nearby numbers: exact, or nearly so, however far from
// the world's origin the camera is.
vec3 instance_origin(InstanceData i) {
    return (vec3(i.axis_x.w, i.axis_y.w, i.axis_z.w) - frame.camera_high) +
           (vec3(i.normal_x.w, i.normal_y.w, i.normal_z.w) - frame.camera_low);
}

// A difference of two points of the mesh, in the world.
vec3 to_world(InstanceData i, vec3 v) { return i.axis_x.xyz * v.x + i.axis_y.xyz * v.y + i.axis_z.xyz * v.z; }

vec3 world_normal(InstanceData i, vec3 normal) {
    return normalize(i.normal_x.xyz * normal.x + i.normal_y.xyz * normal.y + i.normal_z.xyz * normal.z);
}

vec4 world_tangent(InstanceData i, vec4 tangent) {
    vec3 along = to_world(i, tangent.xyz);
    // A mirrored instance turns the bitangent round with it.
    float mirror = dot(cross(i.axis_x.xyz, i.axis_y.xyz), i.axis_z.xyz) < 0.0 ? -1.0 : 1.0;
    return vec4(dot(along, along) > 0.0 ? normalize(along) : vec3(1.0, 0.0, 0.0), tangent.w * mirror);
}
