#include "renderer/image/image.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/image/codecs.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

struct Codec {
    std::string_view extension;
    ColorSpace space;
    Image (*decode)(const std::string& bytes, const std::string& name);
    std::string (*encode)(const Image& image, const std::string& name);
};

constexpr Codec kCodecs[] = {
    {".png", ColorSpace::display, decode_png, encode_png},
    {".exr", ColorSpace::linear, decode_exr, encode_exr},
};

const Codec& codec_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    for (const Codec& codec : kCodecs)
        if (codec.extension == extension) return codec;
    throw InputError(file.string(), "the extension '" + extension + "' is not a picture's; allowed: .png, .exr");
}

}  // namespace

Image read_image(const std::filesystem::path& file) {
    const Codec& codec = codec_of(file);
    return codec.decode(read_file(file), file.string());
}

void write_image(const Image& image, const std::filesystem::path& file) {
    CHECK_THAT(image.width > 0 && image.height > 0 && image.rgb.size() == 3 * image.pixel_count(),
               "{}x{} with {} values", image.width, image.height, image.rgb.size());
    const Codec& codec = codec_of(file);
    const std::string name = file.string();
    write_file_atomically(file, image.space == codec.space ? codec.encode(image, name)
                                                           : codec.encode(converted(image, codec.space), name));
}

void write_grey16_png(int width, int height, std::span<const uint16_t> grey, const std::filesystem::path& file) {
    CHECK_THAT(width > 0 && height > 0 && grey.size() == static_cast<size_t>(width) * height, "{}x{} with {} values",
               width, height, grey.size());
    write_file_atomically(file, encode_grey16_png(width, height, grey, file.string()));
}

Image converted(const Image& image, ColorSpace space) {
    Image result = image;
    if (space == image.space) return result;
    result.space = space;
    std::ranges::transform(result.rgb, result.rgb.begin(),
                           space == ColorSpace::linear ? srgb_to_linear : linear_to_srgb);
    return result;
}

float srgb_to_linear(float v) {
    const float a = std::abs(v);
    const float linear = a <= 0.04045F ? a / 12.92F : std::pow((a + 0.055F) / 1.055F, 2.4F);
    return std::copysign(linear, v);
}

float linear_to_srgb(float v) {
    const float a = std::abs(v);
    const float encoded = a <= 0.0031308F ? a * 12.92F : 1.055F * std::pow(a, 1.0F / 2.4F) - 0.055F;
    return std::copysign(encoded, v);
}

}  // namespace lightsweep
