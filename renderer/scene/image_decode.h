// PNG and JPEG files in memory to texels.
#pragma once

#include "renderer/scene/scene.h"

#include <string_view>

namespace lightsweep {

/// Decodes to 8-bit RGBA (16-bit channels are shortened; alpha is 255 where there is none). Gamma and colour profiles
/// in the file are ignored, as glTF 2.0 asks: `srgb` alone says how the bytes are meant. Thread-safe. Throws InputError
/// naming `place`.
Texture decode_image(std::string_view bytes, std::string name, bool srgb, const std::string& place);

}  // namespace lightsweep
