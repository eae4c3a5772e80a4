// The volume of the light of this draw.
#include "lib/light_volume.glsl"

layout(location = kPositionAttribute) in vec3 position;
layout(location = kLightIndexUniform) uniform uint light_index;

// The marking draw and the shading draw must cover the same pixels.
invariant gl_Position;

void main() { gl_Position = frame.clip_from_world * vec4(volume_point(light_at(light_index), position), 1.0); }
