// glTF 2.0 files (.gltf and .glb): geometry, materials and textures appended to a scene once, to be placed many times.
#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>

namespace lightsweep {

/// What one file became: draws in the file's order, each in the file's own space.
struct GltfModel {
    std::vector<Instance> parts;
    Bounds bounds;  ///< of all parts
};

/// Appends the meshes that the file's default scene shows, with the materials and textures they use. Draws triangles
/// only. Blended materials become opaque; that and whatever else is drawn otherwise than the file asks is said in
/// `scene.warnings`. Throws InputError with file and JSON pointer for anything malformed, for data outside its buffer,
/// and for required extensions other than KHR_mesh_quantization.
GltfModel append_gltf(const std::filesystem::path& file, Scene& scene);

}  // namespace lightsweep
