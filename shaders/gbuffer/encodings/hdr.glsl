// fields: emissive base_color
// channels: float float float
// summary: radiance or colour as it is, in a float format
// source: none needed
vec3 encode_hdr(vec3 c) { return c; }
vec3 decode_hdr(vec3 e) { return e; }
