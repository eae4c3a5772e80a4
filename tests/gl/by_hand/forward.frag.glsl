#include "generated/matte.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 color;

void main() { color = vec4(matte(position, normalize(normal), material.base_color), 1.0); }
