// The targets of the layout float16 that a matte scene needs.
#include "generated/matte.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 base_color;

void main() {
    position = vec4(in_position, 0.0);
    normal = vec4(normalize(in_normal), 0.0);
    base_color = vec4(material.base_color, 0.0);
}
