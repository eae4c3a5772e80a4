// The G-buffer as shading reads it: every field that a layout may lose, as plain floats.
#include "lib/gbuffer_pixel.glsl"

layout(location = 0) out vec4 position_roughness;
layout(location = 1) out vec4 normal_metallic;
layout(location = 2) out vec4 base_color_covered;
layout(location = 3) out vec4 specular;
layout(location = 4) out vec4 emissive;

void main() {
    position_roughness = vec4(0.0);
    normal_metallic = vec4(0.0);
    base_color_covered = vec4(0.0);
    specular = vec4(0.0);
    emissive = vec4(0.0);
    float depth = pixel_depth();
    if (is_background(depth)) return;
    Surface s = read_surface(gl_FragCoord.xy, depth);
    position_roughness = vec4(s.position, s.roughness);
    normal_metallic = vec4(s.normal, s.metallic);
    base_color_covered = vec4(s.base_color, 1.0);
    specular = vec4(s.specular, 0.0);
    emissive = vec4(s.emissive, 0.0);
}
