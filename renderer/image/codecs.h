// The two file formats behind read_image() and write_image(): bytes in, picture out, and back. Knows no folders.
#pragma once

#include "renderer/image/image.h"

#include <span>
#include <string>

namespace lightsweep {

/// The largest picture accepted from a file (16384 x 16384), so that a damaged header cannot ask for all memory.
constexpr int64_t kMaxFilePixels = int64_t{1} << 28;

/// Each decoder throws InputError; `name` stands for the file in its message.
Image decode_png(const std::string& bytes, const std::string& name);
Image decode_exr(const std::string& bytes, const std::string& name);

/// 8-bit RGB. `image` must be in display space; values outside [0, 1] are clamped, NaN becomes 0.
std::string encode_png(const Image& image, const std::string& name);
/// 16-bit grey, said to be linear (gAMA 1). `grey`: width * height values.
std::string encode_grey16_png(int width, int height, std::span<const uint16_t> grey, const std::string& name);
/// 32-bit float RGB, ZIP-compressed. `image` must be in linear space; every value is kept, non-finite ones too.
std::string encode_exr(const Image& image, const std::string& name);

}  // namespace lightsweep
