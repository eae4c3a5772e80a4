// Planes that mirror a light into the camera, for highlights of any width. They stand askew, so that every component of
// every vector rounds, and their corners are seen on the grid to which rasterisers snap.
#pragma once

#include "renderer/scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace lightsweep {

struct MirrorPlane {
    Material material;
    double half_view = 0.5;  ///< tangent of half the angle under which the camera sees the picture's middle row
};

/// The planes, each too far from the others to be seen with them, in a scene that knows points alone.
Scene mirror_planes(std::span<const MirrorPlane> planes);

/// One unit above the middle of plane `index`, which fills a square picture.
Camera mirror_camera(std::span<const MirrorPlane> planes, size_t index);

/// White, 1.5 units above the plane. `across`: off the camera's axis. Its window takes less than 2^-22 there.
Light mirror_light(size_t index, double across);
inline constexpr double kMirrorLightHeight = 1.5;

}  // namespace lightsweep
