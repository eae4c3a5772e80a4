// fields: specular
// channels: unsigned
// summary: one number, the luminance; the hue of a coloured specular is lost
// source: ITU-R BT.709 weights, as in the luminance G-buffers of student renderers
float encode_luminance(vec3 c) { return luminance(c); }
vec3 decode_luminance(float e) { return vec3(e); }
