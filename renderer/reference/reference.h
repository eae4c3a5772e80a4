// The reference: the lit picture that exact arithmetic would give, from surfaces and lights, in double precision on all
// cores. Its formulas are written apart from the shaders' text, so that a wrong one shows. Knows no GL.
#pragma once

#include "renderer/image/image.h"
#include "renderer/reference/surfaces.h"
#include "renderer/scene/scene.h"

#include <span>
#include <vector>

namespace lightsweep {

/// Part of every cached reference's name: raise it when a formula here or in surfaces.cpp changes.
inline constexpr int kReferenceVersion = 3;

/// Linear radiance per pixel, `width` * `height` of them: emission, ambient, every light that reaches; the scene's
/// background where no surface is. Bit-equal for any number of threads.
std::vector<glm::dvec3> shade_reference(const Scene& scene, std::span<const ReferenceSurface> surfaces, int width,
                                        int height, const Camera& camera, std::span<const Light> lights);

/// Rounded once, to a linear image.
Image to_image(std::span<const glm::dvec3> radiance, int width, int height);

/// The display values that shaders/post/tone_map.frag.glsl gives, before they are rounded to 8 bits: exposure 1, the
/// ACES fit of Narkowicz (2015), sRGB encoding. In double precision. NaN becomes 0, +Inf 1.
Image tone_mapped(const Image& linear);

}  // namespace lightsweep
