// Known work per vertex, and none per fragment: every triangle is a point outside the view.
layout(location = 0) uniform uint iterations;

void main() {
    float x = float(gl_VertexID) * 0.001;
    for (uint i = 0u; i < iterations; ++i) x = fract(x * 1.618 + 0.37) * 1.1;
    gl_Position = vec4(2.0 + x, 2.0, 0.5, 1.0);
}
