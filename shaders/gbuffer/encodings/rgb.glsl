// fields: base_color specular
// channels: unsigned unsigned unsigned
// summary: linear colour as it is
// source: none needed
vec3 encode_rgb(vec3 c) { return c; }
vec3 decode_rgb(vec3 e) { return e; }
