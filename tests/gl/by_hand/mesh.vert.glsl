// By hand, for scenes of matte single-coloured surfaces under points alone. Shares with the program's shaders how data
// lies in buffers, and nothing else.
#include "shared/slots.h"
#include "shared/types.h"

layout(std140, binding = kFrameBlock) uniform FrameBlock { FrameData frame; };
layout(binding = kInstanceUnit) uniform samplerBuffer instances;

layout(location = kPositionAttribute) in vec3 position;
layout(location = kNormalAttribute) in vec3 normal;
layout(location = kInstanceAttribute) in uint instance;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;

void main() {
    int first = int(instance) * 6;
    vec4 x = texelFetch(instances, first), y = texelFetch(instances, first + 1), z = texelFetch(instances, first + 2);
    vec4 nx = texelFetch(instances, first + 3), ny = texelFetch(instances, first + 4),
         nz = texelFetch(instances, first + 5);
    vec3 origin = (vec3(x.w, y.w, z.w) - frame.camera_high) + (vec3(nx.w, ny.w, nz.w) - frame.camera_low);
    out_position = x.xyz * position.x + y.xyz * position.y + z.xyz * position.z + origin;
    out_normal = normalize(nx.xyz * normal.x + ny.xyz * normal.y + nz.xyz * normal.z);
    gl_Position = frame.clip_from_world * vec4(out_position, 1.0);
}
