// The surface under every pixel centre in double precision: the pixel's ray meets the plane of the triangle that the
// rasteriser found visible there. Knows no GL and no light.
#pragma once

#include "renderer/reference/visibility.h"
#include "renderer/scene/scene.h"

#include <vector>

namespace lightsweep {

/// What shaders/lib/surface.glsl's Surface holds, without its rounding.
struct ReferenceSurface {
    glm::dvec3 position{0.0};  ///< relative to the camera's eye, along world axes
    glm::dvec3 normal{0.0};    ///< unit, shading normal
    glm::dvec3 base_color{0.0};
    glm::dvec3 specular{0.0};
    glm::dvec3 emissive{0.0};
    double roughness = 0.0;
    double metallic = 0.0;
    ShadingModel model = ShadingModel::ggx;
    bool covered = false;  ///< false: background, and nothing else here means anything
};

/// One per pixel of `visible`. `subpixel_bits`: 0 for the exact triangle; b > 0 for the one that a rasteriser sees that
/// snaps projected vertices to a grid of 2^-b pixels (GL_SUBPIXEL_BITS). On all cores; the same for any number of them.
std::vector<ReferenceSurface> reference_surfaces(const Scene& scene, const Camera& camera, const Visibility& visible,
                                                 int subpixel_bits = 0);

}  // namespace lightsweep
