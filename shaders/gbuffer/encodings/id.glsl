// fields: model
// channels: unsigned
// summary: the shading model's number in thirds, exact in 2 bits or more
// source: none needed
float encode_id(uint model) { return float(model) * (1.0 / 3.0); }
uint decode_id(float e) { return uint(round(e * 3.0)); }
