// fields: emissive base_color
// channels: bits
// summary: 15 bits of radiance: three 4-bit mantissas with one 3-bit exponent, from 1/64 to 30
// source: EXT_texture_shared_exponent's conversion (see rgb9e5) with N = 4, B = 2, Emax = 7
//
// value = mantissa * 2^(exponent - 6).
uint encode_rgb4e3(vec3 c) {
    vec3 clamped = clamp(c, vec3(0.0), vec3(30.0));
    float largest = max(clamped.r, max(clamped.g, clamped.b));
    // The exponent straight from the float's bits: floor(log2(x)) without a logarithm's rounding.
    int exponent = max(-3, int(floatBitsToUint(largest) >> 23) - 127) + 3;
    float scale = exp2(float(6 - exponent));
    if (floor(largest * scale + 0.5) >= 16.0) {
        scale *= 0.5;
        exponent += 1;
    }
    uvec3 mantissa = uvec3(floor(clamped * scale + 0.5));
    return mantissa.r | (mantissa.g << 4) | (mantissa.b << 8) | (uint(exponent) << 12);
}

vec3 decode_rgb4e3(uint e) {
    vec3 mantissa = vec3(e & 15u, (e >> 4) & 15u, (e >> 8) & 15u);
    return mantissa * exp2(float(int(e >> 12) - 6));
}
