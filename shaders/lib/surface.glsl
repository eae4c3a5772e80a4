// What shading needs to know of a surface point. A forward path evaluates it, a deferred path reads it back.
#include "shared/shading_models.h"

struct Surface {
    vec3 position;  // camera-relative
    vec3 normal;    // unit, towards the viewer's side
    vec3 base_color;
    float roughness;  // perceptual
    float metallic;
    vec3 specular;  // Blinn-Phong only
    vec3 emissive;
    uint model;
};

float luminance(vec3 linear_color) { return dot(linear_color, vec3(0.2126, 0.7152, 0.0722)); }  // ITU-R BT.709
