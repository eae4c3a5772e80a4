// What the GPU is asked besides pictures: which triangle each pixel sees, and what a layout gives back of its surface.
// Rows come out from the top.
#pragma once

#include "bench/measure/arm.h"
#include "renderer/reference/visibility.h"

#include <vector>

namespace lightsweep {

/// Draws the visibility pass of the subject's view and reads it back. Of `layout`, the depth alone counts; of `skips`,
/// which of two surfaces at one depth comes first.
Visibility draw_visibility(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes,
                           const Layout& layout = {}, SkipSet skips = SkipSet::all());

/// What shading reads of a pixel from a layout's G-buffer.
struct DecodedSurface {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec3 base_color{0.0F};
    glm::vec3 specular{0.0F};
    glm::vec3 emissive{0.0F};
    float roughness = 0.0F;
    float metallic = 0.0F;
    bool covered = false;
};

/// Draws the layout's G-buffer of the subject's view and reads it back, one surface per pixel.
std::vector<DecodedSurface> draw_decoded_surface(PathSetup setup, const Subject& subject, FrameBuffers& buffers,
                                                 const DrawShapes& shapes);

}  // namespace lightsweep
