// One triangle that covers the target: (-1,-1), (3,-1), (-1,3). COVERED_ONLY: at the depth of the background, so that a
// depth test that asks for something nearer there keeps a pass to the pixels with a surface.
#ifdef COVERED_ONLY
#include "lib/frame.glsl"
#endif

void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2), float((gl_VertexID & 2) << 1));
#ifdef COVERED_ONLY
    float depth = frame.depth_clear;
#else
    float depth = 0.0;
#endif
    gl_Position = vec4(corner - 1.0, depth, 1.0);
}
