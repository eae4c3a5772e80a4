#include "renderer/reference/cache.h"

#include "renderer/base/file.h"
#include "renderer/base/hash.h"
#include "renderer/reference/reference.h"

#include <unistd.h>

#include <fmt/format.h>

#include <exception>
#include <system_error>
#include <type_traits>

namespace lightsweep {
namespace {

namespace fs = std::filesystem;

// The bytes that make a key.
class KeyBytes {
  public:
    // Types without padding, one by one.
    template <typename... T>
    void add(const T&... values) {
        static_assert((std::is_trivially_copyable_v<T> && ...));
        (bytes_.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    }
    // Millions of them: by their own hash.
    template <typename T>
    void add_hash_of(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(values.size(), hash_bytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}));
    }
    void add_text(const std::string& text) {
        add(text.size());
        bytes_ += text;
    }
    std::string hex() const { return hash_hex(bytes_); }

  private:
    std::string bytes_;
};

}  // namespace

std::string reference_key(const Scene& scene, const Camera& camera, std::span<const Light> lights,
                          const Visibility& visible, int subpixel_bits) {
    static_assert(sizeof(VisibleTriangle) == 2 * sizeof(uint32_t) && sizeof(SampledTexels) == 11 * sizeof(float),
                  "both are hashed as bytes and must have no padding");
    KeyBytes key;
    key.add(kReferenceVersion, subpixel_bits);
    key.add_text(scene.content_hash);
    key.add(camera.eye, camera.target, camera.up, camera.fov_y_deg, camera.near_distance, camera.far_distance);
    key.add(lights.size());
    for (const Light& l : lights) key.add(l.kind, l.position, l.direction, l.color, l.radius, l.inner_deg, l.outer_deg);
    key.add(visible.width, visible.height);
    key.add_hash_of(visible.triangles);
    key.add_hash_of(visible.texels);
    return key.hex();
}

ReferenceCache::ReferenceCache() : ReferenceCache(cache_folder()) {}

std::optional<Image> ReferenceCache::find(const std::string& key, int width, int height) const {
    const fs::path file = folder_ / (key + ".exr");
    std::error_code missing;
    if (folder_.empty() || !fs::exists(file, missing)) return std::nullopt;
    try {
        Image image = read_image(file);
        if (image.width == width && image.height == height) return image;
    } catch (const std::exception&) {  // damaged: as good as missing
    }
    return std::nullopt;
}

void ReferenceCache::store(const std::string& key, const Image& image) const {
    if (folder_.empty()) return;
    // Its own name in every process: two that compute the same picture do not write into one file.
    const fs::path part = folder_ / fmt::format("{}.{}.exr", key, ::getpid());
    try {
        fs::create_directories(folder_);
        write_image(image, part);
        fs::rename(part, folder_ / (key + ".exr"));
    } catch (const std::exception&) {  // no space, no right to write: the next run computes again
        std::error_code ignored;
        fs::remove(part, ignored);
    }
}

}  // namespace lightsweep
