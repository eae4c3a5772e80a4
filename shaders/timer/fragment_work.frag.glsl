// Known work per fragment: a chain of dependent operations, `iterations` long, that no compiler can shorten.
layout(location = 0) uniform uint iterations;
layout(location = 0) out vec4 color;

void main() {
    float x = gl_FragCoord.x * 0.001 + gl_FragCoord.y * 0.0007;
    for (uint i = 0u; i < iterations; ++i) x = fract(x * 1.618 + 0.37) * 1.1;
    color = vec4(x);
}
