// Known work per invocation.
layout(local_size_x = 64) in;
layout(location = 0) uniform uint iterations;
layout(std430, binding = 0) buffer Output { float result[]; };

void main() {
    float x = float(gl_GlobalInvocationID.x) * 0.001;
    for (uint i = 0u; i < iterations; ++i) x = fract(x * 1.618 + 0.37) * 1.1;
    result[gl_GlobalInvocationID.x] = x;
}
