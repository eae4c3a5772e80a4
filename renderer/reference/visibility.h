// Which surface each pixel centre sees, as the rasteriser decided it, and the texels sampled there: what the reference
// takes from the GPU. Plain data, no GL.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace lightsweep {

inline constexpr uint32_t kNoSurface = 0xffffffffU;

struct VisibleTriangle {
    uint32_t instance = kNoSurface;  ///< index into Scene::instances; kNoSurface: background
    uint32_t triangle = 0;           ///< index into the mesh's triangles
};

/// Values as a shader's texture() gives them: filtered, colours decoded to linear; 1 where a material has no texture,
/// (0.5, 0.5, 1) for its normal.
struct SampledTexels {
    glm::vec3 base_color;
    float roughness;
    glm::vec3 normal;  ///< as stored, [0, 1]
    float metallic;
    glm::vec3 emissive;
};

/// Row by row from the top row, as Image.
struct Visibility {
    int width = 0;
    int height = 0;
    std::vector<VisibleTriangle> triangles;  ///< width * height
    std::vector<SampledTexels> texels;       ///< as many, or none when the scene has no textures
};

}  // namespace lightsweep
