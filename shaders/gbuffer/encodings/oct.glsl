// fields: normal
// channels: signed signed
// summary: octahedral map of the unit sphere to a square
// source: Meyer et al. 2010, "On Floating-Point Normal Vectors"; Cigolle et al. 2014, JCGT 3(2), listing 1
vec2 oct_sign(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

vec2 encode_oct(vec3 n) {
    vec2 p = n.xy * (1.0 / (abs(n.x) + abs(n.y) + abs(n.z)));
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * oct_sign(p);
}

vec3 decode_oct(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * oct_sign(n.xy);
    return normalize(n);
}
