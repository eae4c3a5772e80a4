// Pictures as plain float data, and their files: PNG (8-bit sRGB) and OpenEXR (32-bit float linear). Knows no GL.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lightsweep {

/// What the numbers of an image are.
enum class ColorSpace {
    linear,   ///< scene-linear radiance, unbounded (EXR)
    display,  ///< sRGB-encoded display values in [0, 1] (PNG)
};

/// RGB float, row by row from the top row; no padding. Alpha is not carried: no path writes one.
struct Image {
    int width = 0;
    int height = 0;
    ColorSpace space = ColorSpace::linear;
    std::vector<float> rgb;  ///< 3 * width * height

    Image() = default;
    Image(int w, int h, ColorSpace s) : width(w), height(h), space(s), rgb(size_t{3} * w * h) {}
    size_t pixel_count() const { return static_cast<size_t>(width) * height; }
    float* pixel(int x, int y) { return &rgb[3 * (static_cast<size_t>(y) * width + x)]; }
    const float* pixel(int x, int y) const { return &rgb[3 * (static_cast<size_t>(y) * width + x)]; }
};

/// Reads .png (to display values in [0, 1]; alpha is composited over black; 16-bit files keep their precision) or .exr
/// (to linear, the data window of the first part). Colour chunks (gAMA, iCCP, chromaticities) are not applied: two
/// files are compared as stored. Throws InputError naming the file: missing, not an image, truncated, no RGB or Y
/// channel.
Image read_image(const std::filesystem::path& file);

/// Writes .png or .exr, by extension. A display image goes to PNG as it is, rounded to nearest; a linear image is
/// sRGB-encoded and clamped first (non-finite: NaN becomes 0, +Inf 1). A display image in EXR is converted to linear.
/// Throws InputError.
void write_image(const Image& image, const std::filesystem::path& file);

/// Writes numbers, not a picture to look at: a grey PNG of 16 bits, `grey` row by row from the top row, kept as they
/// are. Throws InputError.
void write_grey16_png(int width, int height, std::span<const uint16_t> grey, const std::filesystem::path& file);

/// The same picture in another space, by the sRGB curve alone: no tone mapping and no clamp.
Image converted(const Image& image, ColorSpace space);

/// IEC 61966-2-1, scalar, any input (negative values pass through mirrored).
float srgb_to_linear(float v);
float linear_to_srgb(float v);

}  // namespace lightsweep
