// A sphere around the light of this draw. The mesh encloses the unit sphere, so that its flat faces cut nothing off.
#include "lib/frame.glsl"
#include "lib/light.glsl"

layout(location = kPositionAttribute) in vec3 position;
layout(location = kLightIndexUniform) uniform uint light_index;

// The marking draw and the shading draw must cover the same pixels.
invariant gl_Position;

void main() {
    LightData light = light_at(light_index);
    gl_Position = frame.clip_from_world * vec4(light.position + light.radius * position, 1.0);
}
