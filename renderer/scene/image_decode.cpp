#include "renderer/scene/image_decode.h"

#include "renderer/base/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>

#include <limits>
#include <memory>

namespace lightsweep {

Texture decode_image(std::string_view bytes, std::string name, bool srgb, const std::string& place) {
    if (bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
        throw InputError(place, "the image file is larger than 2 GiB");
    }
    Texture texture{.name = std::move(name), .srgb = srgb, .rgba = {}};
    int channels_in_file = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()),
                              &texture.width, &texture.height, &channels_in_file, STBI_rgb_alpha),
        stbi_image_free);
    if (!texels) {
        throw InputError(place, std::string("the image cannot be decoded (") + stbi_failure_reason() +
                                    "); PNG and JPEG up to 16384 x 16384 are read");
    }
    texture.rgba.assign(texels.get(),
                        texels.get() + 4 * static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height));
    return texture;
}

}  // namespace lightsweep
