// The direction of a vector of any length.
#include "lib/guards.glsl"

// A power of two, so that multiplying by it rounds nothing, that brings a positive number between 1/4 and 4. Read off
// the exponent's bits: 2^-e for 2^e, kept above the denormals.
float scale_to_one(float size) {
    return uintBitsToFloat(max(0x7f000000u - (floatBitsToUint(size) & 0x7f800000u), 0x00800000u));
}

// Unit length for every finite vector with a component of at least 2^-126; `fallback` for zero, Inf and NaN. The square
// of a length above 2^63 or below 2^-63 leaves the range of a float: so the largest component is brought near 1 first.
vec3 safe_normalize(vec3 v, vec3 fallback) {
    vec3 size = abs(v);
    vec3 scaled = v * scale_to_one(max(size.x, max(size.y, size.z)));
    float length_squared = dot(scaled, scaled);
    // At most 3 * 4^2. NaN is neither above nor below.
    bool usable = length_squared > 0.0 && length_squared < 64.0;
    return GUARDED(usable ? scaled * inversesqrt(length_squared) : fallback, normalize(v));
}
