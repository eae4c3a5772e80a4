// Procedural textures, so that the shipped scenes need no image files. The same parameters give the same bytes; every
// one of them tiles.
#pragma once

#include "renderer/scene/scene.h"

#include <array>

namespace lightsweep {

/// How a texture of colours is stored: size in texels (square), and whether the bytes are sRGB-encoded.
struct TextureFormat {
    int size = 256;
    bool srgb = false;
};

/// Linear, [0, 1].
using ColorPair = std::array<glm::dvec3, 2>;

/// `squares` x `squares` squares of alternating colours; the first stands at (0, 0). `squares` is even, so that it
/// tiles.
Texture make_checker(const TextureFormat& format, int squares, const ColorPair& colors);

/// Colours mixed by fractal value noise: `octaves` sums, the first with `cells` x `cells` lattice points.
Texture make_noise(const TextureFormat& format, int cells, int octaves, uint64_t seed, const ColorPair& colors);

/// One colour with `count` x `count` round holes of alpha 0; `radius` as a part of a cell, (0, 1/2].
Texture make_holes(const TextureFormat& format, int count, double radius, const glm::dvec3& color);

/// A tangent-space normal map (+Y up) of `count` x `count` sine bumps, `height` as a part of the bump's width.
Texture make_bumps(int size, int count, double height);

}  // namespace lightsweep
