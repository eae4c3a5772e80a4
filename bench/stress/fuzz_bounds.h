// How far 32-bit arithmetic may take a picture from exact values: what a pixel's radiance moves by when what a GPU
// rounds on its way there is moved as far as it may be rounded. In double precision, by the reference; knows no GL.
#pragma once

#include "renderer/reference/surfaces.h"
#include "renderer/reference/visibility.h"
#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace lightsweep {

/// Four roundings of 2^-24: of a value that is a sum of products.
inline constexpr double kRoundings = 4 * 0x1p-24;

/// How far a pixel's surface may be off: in scene units, in radians.
struct SurfaceStep {
    double position = 0.0, normal = 0.0;
};

/// Of surfaces that are known exactly: what shading itself rounds of their place and normal.
std::vector<SurfaceStep> shading_steps(std::span<const ReferenceSurface> surfaces);

/// Of what a rasteriser interpolates in 32-bit floats: over a triangle of `height` pixels at its narrowest, window
/// coordinates known to 2^-24 of the target's size move the weights by 2^-24 size / height; one over the distance,
/// known to 2^-24 of its largest value over the triangle, moves them by that over its value at the pixel.
std::vector<SurfaceStep> interpolation_steps(const Scene& scene, const Camera& camera, const Visibility& visible,
                                             std::span<const ReferenceSurface> surfaces);

/// Of what shaders/lib/visible_surface.glsl rebuilds from a triangle with corner c, edges a and b and normal n = a x b,
/// seen along d: n is off by 2^-24 |a| |b|, so n.d by K = |a| |b| |d| / |n.d| of itself, n.c likewise, and the weights
/// d.(b x c) / d.n by |d| |edge| |c| / |n.d|.
std::vector<SurfaceStep> rebuilding_steps(const Scene& scene, const Camera& camera, const Visibility& visible,
                                          std::span<const ReferenceSurface> surfaces);

/// The lights as shaders are given them: relative to the eye, in 32-bit floats. For a camera whose eye is the origin.
std::vector<Light> lights_in_float(std::span<const Light> lights, const glm::dvec3& eye);

/// Exact radiance, and how far rounding may move each pixel's largest channel.
struct BoundedRadiance {
    std::vector<glm::dvec3> radiance;
    std::vector<double> movement;
};

/// Moves surfaces by `steps` along three axes, and their normals both ways across; narrows the lights' reach and shifts
/// their cones by kRoundings. Sums what each does. `lights`: relative to the eye.
BoundedRadiance bounded_radiance(const Scene& scene, std::span<const ReferenceSurface> surfaces,
                                 std::span<const SurfaceStep> steps, int width, int height,
                                 std::span<const Light> lights);

}  // namespace lightsweep
