// fields: base_color specular
// channels: unsigned signed
// needs: pixel neighbours
// summary: luma, and one of two chromas in a checkerboard; the other one comes from the neighbours of like luma
// source: Mavridis and Papaioannou 2012, "The Compact YCoCg Frame Buffer", JCGT 1(1): YCoCg, checkerboard, edge-directed filter
//
// On square roots (gamma2), so that luma's steps suit the eye. Chroma is in [-1/2, 1/2] and stored times two.
#include "lib/guards.glsl"

const float kLumaEdge = 30.0 / 255.0;  // the paper's: a neighbour whose luma differs more is across an edge

bool stores_orange(ivec2 pixel) { return ((pixel.x ^ pixel.y) & 1) == 0; }

vec2 encode_ycocg(vec3 c, ivec2 pixel) {
    vec3 e = sqrt(GUARDED(max(c, vec3(0.0)), c));
    float orange = e.r - e.b, green = e.g - 0.5 * (e.r + e.b);
    return vec2(0.25 * e.r + 0.5 * e.g + 0.25 * e.b, stores_orange(pixel) ? orange : green);
}

vec3 decode_ycocg(vec2 e, ivec2 pixel, vec2 near[4], vec4 present) {
    vec4 luma = vec4(near[0].x, near[1].x, near[2].x, near[3].x);
    vec4 chroma = vec4(near[0].y, near[1].y, near[2].y, near[3].y);
    vec4 weight = present * (1.0 - step(kLumaEdge, abs(luma - e.x)));
    // All across an edge: any of them is better than none.
    if (weight == vec4(0.0)) weight = present;
    float missing = dot(weight, chroma) / max(dot(weight, vec4(1.0)), 1.0);
    vec2 orange_green = 0.5 * (stores_orange(pixel) ? vec2(e.y, missing) : vec2(missing, e.y));
    float between = e.x - orange_green.y;
    vec3 root = clamp(vec3(between + orange_green.x, e.x + orange_green.y, between - orange_green.x), 0.0, 1.0);
    return root * root;
}
