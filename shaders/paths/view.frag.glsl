// One buffer of the G-buffer, read back: the values, and a picture of them.
#include "lib/gbuffer_pixel.glsl"
#include "lib/light.glsl"
#include "lib/view_colors.glsl"

layout(location = 0) out vec4 value;
layout(location = 1) out vec4 picture;

void main() {
    value = vec4(0.0, 0.0, 0.0, 1.0);
    picture = value;
    float depth = pixel_depth();
    if (is_background(depth)) return;
    Surface s = read_surface(gl_FragCoord.xy, depth);
#if defined(VIEW_DEPTH)
    float z = view_distance(depth);
    value.rgb = vec3(z);
    picture.rgb = vec3(clamp(log2(1.0 + z) / 8.0, 0.0, 1.0));
#elif defined(VIEW_NORMAL)
    value.rgb = s.normal;
    picture.rgb = s.normal * 0.5 + 0.5;
#elif defined(VIEW_BASE_COLOR)
    value.rgb = s.base_color;
    picture.rgb = sqrt(s.base_color);
#elif defined(VIEW_ROUGHNESS)
    value.rgb = vec3(s.roughness);
    picture.rgb = value.rgb;
#elif defined(VIEW_METALLIC)
    value.rgb = vec3(s.metallic);
    picture.rgb = value.rgb;
#elif defined(VIEW_POSITION)
    value.rgb = s.position;
    picture.rgb = fract(s.position);
#elif defined(VIEW_LUMINANCE)
    value.rgb = vec3(luminance(s.base_color));
    picture.rgb = sqrt(value.rgb);
#elif defined(VIEW_LIGHTS)
    uint count = 0u;
    for (uint i = frame.directional_count; i < frame.light_count; ++i) count += reaches(light_at(i), s.position) ? 1u : 0u;
    value.rgb = vec3(float(count));
    picture.rgb = count == 0u ? vec3(0.0) : ramp(clamp(log2(float(count)) / 5.0, 0.0, 1.0));
#endif
}
