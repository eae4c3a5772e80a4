// An instance's transform, for the vertex shader and for passes that fetch vertices themselves.
#include "lib/frame.glsl"
#include "lib/safe_normalize.glsl"

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

// Zero where the transform leaves a normal no direction: a singular one flattens what is round. The vertices beside it
// then have the say.
vec3 world_normal(InstanceData i, vec3 normal) {
    return safe_normalize(i.normal_x.xyz * normal.x + i.normal_y.xyz * normal.y + i.normal_z.xyz * normal.z, vec3(0.0));
}

vec4 world_tangent(InstanceData i, vec4 tangent) {
    // A mirrored instance turns the bitangent round with it. The columns for normals have at most unit size, whatever
    // the scale: of the axes themselves, the triple product leaves the range of floats beyond 1e12 and below 1e-15.
    float mirror = dot(cross(i.normal_y.xyz, i.normal_z.xyz), i.axis_x.xyz) < 0.0 ? -1.0 : 1.0;
    return vec4(safe_normalize(to_world(i, tangent.xyz), vec3(1.0, 0.0, 0.0)), tangent.w * mirror);
}
