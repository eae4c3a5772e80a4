// fields: position
// channels: float float float
// summary: the camera-relative position, stored
// source: Saito and Takahashi 1990, "Comprehensible Rendering of 3-D Shapes"
vec3 encode_position(vec3 p) { return p; }
vec3 decode_position(vec3 e) { return e; }
