// References on disk, named by a hash of everything they depend on, so that a second run computes none.
#pragma once

#include "renderer/image/image.h"
#include "renderer/reference/visibility.h"
#include "renderer/scene/scene.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace lightsweep {

/// hash_hex of the scene's content, the camera, the lights, the visibility (so the size, and what the device sampled),
/// `subpixel_bits` and kReferenceVersion.
std::string reference_key(const Scene& scene, const Camera& camera, std::span<const Light> lights,
                          const Visibility& visible, int subpixel_bits);

class ReferenceCache {
  public:
    /// In cache_folder(); made when first written to.
    ReferenceCache();
    explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Nothing when it is not there, or is not the picture it should be (damaged, another size): then it is computed
    /// again.
    std::optional<Image> find(const std::string& key, int width, int height) const;
    /// As <key>.exr, put in place atomically. A cache that cannot be written is no error: the next run computes again.
    void store(const std::string& key, const Image& image) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace lightsweep
