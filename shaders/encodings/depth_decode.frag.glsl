// The distance that each pixel's depth stands for.
#include "lib/frame.glsl"

layout(binding = kTargetUnit) uniform sampler2D depth_texture;
layout(location = 0) out vec4 value;

void main() {
    value = vec4(view_distance(texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r), 0.0, 0.0, 0.0);
}
