// One triangle that covers the target, (-1,-1), (3,-1), (-1,3), at the depth of the background: a depth test that asks
// for something nearer there keeps a pass to the pixels with a surface.
#include "lib/frame.glsl"

void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2), float((gl_VertexID & 2) << 1));
    gl_Position = vec4(corner - 1.0, frame.depth_clear, 1.0);
}
