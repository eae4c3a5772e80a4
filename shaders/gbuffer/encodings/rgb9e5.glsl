// fields: emissive base_color
// channels: bits
// summary: radiance or colour as three 9-bit mantissas with one 5-bit exponent
// source: EXT_texture_shared_exponent, section "Appendix: shared exponent conversion"; largest value 65408
uint encode_rgb9e5(vec3 c) {
    vec3 clamped = clamp(c, vec3(0.0), vec3(65408.0));
    float largest = max(clamped.r, max(clamped.g, clamped.b));
    // The exponent straight from the float's bits: floor(log2(x)) without a logarithm's rounding.
    int exponent = max(-16, int(floatBitsToUint(largest) >> 23) - 127) + 16;
    float scale = exp2(float(24 - exponent));
    if (floor(largest * scale + 0.5) >= 512.0) {
        scale *= 0.5;
        exponent += 1;
    }
    uvec3 mantissa = uvec3(floor(clamped * scale + 0.5));
    return mantissa.r | (mantissa.g << 9) | (mantissa.b << 18) | (uint(exponent) << 27);
}

vec3 decode_rgb9e5(uint e) {
    vec3 mantissa = vec3(e & 511u, (e >> 9) & 511u, (e >> 18) & 511u);
    return mantissa * exp2(float(int(e >> 27) - 24));
}
