// From HDR radiance to display values: exposure 1, the ACES fit of Narkowicz (2015), sRGB encoding.
#include "shared/slots.h"

layout(binding = kTargetUnit) uniform sampler2D hdr_texture;
layout(location = 0) out vec4 color;

vec3 aces_fit(vec3 x) { return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14); }

// IEC 61966-2-1.
vec3 srgb_encode(vec3 x) {
    return mix(1.055 * pow(max(x, vec3(1e-10)), vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

void main() {
    vec3 radiance = texelFetch(hdr_texture, ivec2(gl_FragCoord.xy), 0).rgb;
    // NaN shows black; the cap keeps Inf from becoming Inf / Inf. Both are counted on the HDR image.
    radiance = mix(clamp(radiance, 0.0, 65504.0), vec3(0.0), isnan(radiance));
    color = vec4(srgb_encode(clamp(aces_fit(radiance), 0.0, 1.0)), 1.0);
}
