// Stores each pixel's value as a layout of one field does.
#include "encodings/samples.glsl"
#define GBUFFER_WRITE
#include "generated/gbuffer.glsl"

void main() {
    Surface s;
    from_sample(sample_of(ivec2(gl_FragCoord.xy)), s.FIELD);
    write_surface(s);
}
