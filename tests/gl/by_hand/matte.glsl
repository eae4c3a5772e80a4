// Light of all points on a matte surface, camera-relative.
#include "shared/slots.h"
#include "shared/types.h"

layout(std140, binding = kFrameBlock) uniform FrameBlock { FrameData frame; };
layout(std140, binding = kMaterialBlock) uniform MaterialBlock { MaterialData material; };
layout(binding = kLightUnit) uniform samplerBuffer lights;

vec3 matte(vec3 position, vec3 normal, vec3 base_color) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < frame.light_count; ++i) {
        vec4 place = texelFetch(lights, int(i) * 3);
        vec3 to_light = place.xyz - position;
        float d2 = dot(to_light, to_light), r2 = place.w * place.w;
        if (d2 >= r2) continue;
        float cosine = dot(normal, to_light) * inversesqrt(max(d2, 1e-20));
        if (cosine <= 0.0) continue;
        float ratio = d2 / r2, window = max(1.0 - ratio * ratio, 0.0);
        sum += texelFetch(lights, int(i) * 3 + 1).xyz * (window * window / max(d2, 1e-4)) * cosine;
    }
    return base_color * (frame.ambient + sum * (1.0 / 3.14159265358979));
}
