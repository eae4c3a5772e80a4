#include "generated/matte.glsl"

layout(binding = kTargetUnit) uniform sampler2D positions;
layout(binding = kTargetUnit + 1) uniform sampler2D normals;
layout(binding = kTargetUnit + 2) uniform sampler2D base_colors;
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    color = vec4(matte(texelFetch(positions, pixel, 0).xyz, normalize(texelFetch(normals, pixel, 0).xyz),
                       texelFetch(base_colors, pixel, 0).xyz),
                 1.0);
}
