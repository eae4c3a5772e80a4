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
    float depth_scale;        // view distance z = depth_scale / (depth - depth_clear + depth_offset)
    vec3 camera_low;
    float depth_offset;
    vec3 ray_right;           // position = z * (ndc.x * ray_right + ndc.y * ray_up + ray_forward)
    float depth_clear;        // the depth where no surface is, and at the far plane
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
    uint double_sided;
    uint unused_0;
    uint unused_1;
    uint unused_2;
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

// The grid of cells that lights are listed for: tiles of the screen, cut into slices of view distance z. Cell (x, y, s)
// has the index (s * tiles_y + y) * tiles_x + x. Slice s holds floor(log2(z) * slice_scale + slice_offset) == s, the
// first and the last one everything below and above.
struct LightGridData {
    uint tile_px;  // edge of a tile; tile (0, 0) is at the lower left
    uint tiles_x;
    uint tiles_y;
    uint slices;  // 1: tiles alone
    float slice_scale;
    float slice_offset;
    float tangent_per_px_x;  // the ray of pixel x has the slope x / z = x * tangent_per_px_x - tan_x
    float tangent_per_px_y;
    float tan_x;
    float tan_y;
    uint word_count;  // 32-bit words that hold one bit for each point and spot light
    uint index_capacity;  // of the buffer of indices
};

// What a point or spot light reaches, in view space: x right, y up, z the view distance. Grown by what the position of a
// surface may be off (light_bounds of renderer/frame), so that a light which reaches that position is never missed.
struct LightBounds {
    vec3 center;  // of a sphere around all of it
    float radius;
    vec3 apex;  // where the light is
    float range;
    vec3 axis;             // of a spot's cone, unit
    float cos_half_angle;  // -1: no cone
};

#ifdef __cplusplus
static_assert(sizeof(LightGridData) == 48);
static_assert(sizeof(LightBounds) == 48);
static_assert(sizeof(FrameData) == 176);
static_assert(sizeof(InstanceData) == 96);
static_assert(sizeof(MaterialData) == 80);
static_assert(sizeof(LightData) == 48);
}  // namespace lightsweep::shared
#endif
