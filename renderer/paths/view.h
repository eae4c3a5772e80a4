// Looking into a cell: one buffer shown instead of the lit picture. Not a path to measure; `lightsweep render --view`.
#pragma once

#include "renderer/pass/path.h"

#include <string>
#include <vector>

namespace lightsweep {

/// final, depth, normal, base_color, roughness, metallic, position, luminance, lights, material.
const std::vector<std::string>& view_names();

/// A path that fills the layout's G-buffer and shows what comes out of it again (so the layout's losses are seen).
/// `hdr` holds the values themselves, `display` a picture of them. `view` is any of view_names() but "final".
///   depth       view distance; the picture: near black, far white, logarithmic
///   normal      world axes; the picture: n / 2 + 1 / 2
///   position    camera-relative; the picture: fract, one cycle per unit
///   luminance   BT.709, of the base colour
///   lights      how many point and spot lights reach the pixel; the picture: black 0, blue 1 .. red 32 and more
///   material    the material's index; the picture: a colour for each
Path build_view(const std::string& view, const PathSetup& setup);

}  // namespace lightsweep
