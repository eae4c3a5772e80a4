// The HDR image as display values.
#include "lib/display.glsl"
#include "shared/slots.h"

layout(binding = kTargetUnit) uniform sampler2D hdr_texture;
layout(location = 0) out vec4 color;

void main() { color = vec4(displayed(texelFetch(hdr_texture, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
