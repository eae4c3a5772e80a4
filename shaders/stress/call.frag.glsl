// Calls the function that a ShaderCall made, once for each pixel, with what that pixel's texels hold.
#include "shared/slots.h"

layout(binding = kTargetUnit + 0) uniform sampler2D a_texture;
layout(binding = kTargetUnit + 1) uniform sampler2D b_texture;
layout(binding = kTargetUnit + 2) uniform sampler2D c_texture;
layout(binding = kTargetUnit + 3) uniform sampler2D d_texture;

#include "generated/call.glsl"

layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    result = call(texelFetch(a_texture, pixel, 0), texelFetch(b_texture, pixel, 0), texelFetch(c_texture, pixel, 0),
                  texelFetch(d_texture, pixel, 0));
}
