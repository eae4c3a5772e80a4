// Structs that C++ writes and GLSL reads. Only vec4, mat4, vec3 followed by a scalar, and scalars: then std140, std430
// and C++ agree. Padding is written out.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
#include <cstdint>
namespace lightsweep::shared {
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
#endif

// Positions in shaders are relative to the camera, along world axes: a camera far from the origin loses no bits.
struct FrameData {
    mat4 clip_from_world;     // camera-relative world to clip
    vec3 camera_high;         // the camera's world position is camera_high + camera_low
    float depth_scale;        // view distance z = depth_scale / (depth + depth_offset), for both conventions
    vec3 camera_low;
    float depth_offset;
    vec3 ray_right;           // position = z * (ndc.x * ray_right + ndc.y * ray_up + ray_forward)
    float depth_clear;        // the depth where no surface is
    vec3 ray_up;
    uint directional_count;   // lights [0, directional_count) are directional,
    vec3 ray_forward;
    uint light_count;         // lights [directional_count, light_count) are points and spots
    vec3 ambient;
    float pixel_to_ndc_x;     // 2 / width
    vec3 background;
    float pixel_to_ndc_y;     // 2 / height
};

struct InstanceData {
    vec4 axis_x;    // model matrix, column x; w: world translation, high part, x
    vec4 axis_y;    // ... y
    vec4 axis_z;
    vec4 normal_x;  // inverse transpose times a positive factor, column x; w: world translation, low part, x
    vec4 normal_y;
    vec4 normal_z;
};

// One draw has one material: a uniform block, so that every device reads it as constants.
struct MaterialData {
    vec3 base_color;
    float roughness;
    vec3 specular;
    float metallic;
    vec3 emissive;
    uint model;
    float normal_scale;             // 0 without a normal map
    float alpha_cutoff;
    float specular_from_luminance;  // 1: specular is multiplied by the luminance of the base colour
    uint id;                        // index in the scene; the material view shows it
};

// A point is a spot whose cone never ends: spot_scale 0, spot_offset 1.
struct LightData {
    vec3 position;  // camera-relative; unused by directional lights
    float radius;   // the light is exactly zero from here on
    vec3 color;     // intensity (point, spot) or irradiance (directional)
    float spot_scale;
    vec3 direction;  // the way the light travels
    float spot_offset;
};

#ifdef __cplusplus
static_assert(sizeof(FrameData) == 176);
static_assert(sizeof(InstanceData) == 96);
static_assert(sizeof(MaterialData) == 64);
static_assert(sizeof(LightData) == 48);
}  // namespace lightsweep::shared
#endif
