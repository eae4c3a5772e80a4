// From HDR radiance to display values: exposure 1, the ACES fit of Narkowicz (2015), sRGB encoding. What is no number
// ends here: a picture never shows it, and it is counted on the HDR image.
#include "lib/guards.glsl"

// Of a half float; the fit is flat long before. Infinity would become Inf / Inf.
const float kLargestShown = 65504.0;

// NaN is black: no comparison with it is true.
vec3 shown_radiance(vec3 radiance) {
    return GUARDED(mix(vec3(0.0), min(radiance, vec3(kLargestShown)), greaterThan(radiance, vec3(0.0))), radiance);
}

vec3 aces_fit(vec3 x) { return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14); }

// IEC 61966-2-1. `mix` computes both branches: the power of 0 is kept from the one that is not taken.
vec3 srgb_encode(vec3 x) {
    vec3 base = GUARDED(max(x, vec3(1e-10)), x);
    return mix(1.055 * pow(base, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

vec3 displayed(vec3 radiance) { return srgb_encode(clamp(aces_fit(shown_radiance(radiance)), 0.0, 1.0)); }
