// Materials and textures of a glTF file, in our terms.
#pragma once

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/scene.h"

#include <map>
#include <set>

namespace lightsweep {

/// The index that primitives without a material have.
inline constexpr int kDefaultGltfMaterial = -1;

/// Appends the materials at `indices` of the file, and the textures they use, decoded on all cores. Returns the index
/// of each in `scene.materials`.
std::map<int, uint32_t> append_gltf_materials(const GltfFile& file, const std::set<int>& indices, Scene& scene);

}  // namespace lightsweep
