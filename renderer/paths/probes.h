// Paths that are not measured but measure: what the rasteriser sees, and what a layout gives back. Their targets are
// read back as numbers; they light nothing.
#pragma once

#include "renderer/pass/path.h"

namespace lightsweep {

struct VisibleTrianglePath {
    Path path;
    TargetId triangles;  ///< RG32UI: instance + 1 (0: background), triangle of the mesh
    /// RGBA32F each, none when the scene has no textures: base colour and roughness, normal and metallic, emissive.
    TargetId base_color_roughness, normal_metallic, emissive;
};

/// Which triangle each pixel centre sees, with the texels sampled there (before the material's factors).
VisibleTrianglePath build_visible_triangles(const PathSetup& setup);

struct DecodedSurfacePath {
    Path path;
    /// RGBA32F each. base_color_covered.a is 1 where a surface is.
    TargetId position_roughness, normal_metallic, base_color_covered, specular, emissive;
};

/// Fills the layout's G-buffer and reads it back as shading does.
DecodedSurfacePath build_decoded_surface(const PathSetup& setup);

}  // namespace lightsweep
