// fields: roughness metallic
// channels: unsigned
// summary: as it is
// source: none needed
float encode_linear(float v) { return v; }
float decode_linear(float e) { return e; }
