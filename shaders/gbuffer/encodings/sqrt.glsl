// fields: roughness metallic
// channels: unsigned
// summary: square root, so that smooth surfaces keep their bits
// source: none needed
float encode_sqrt(float v) { return sqrt(max(v, 0.0)); }
float decode_sqrt(float e) { return e * e; }
