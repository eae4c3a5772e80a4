// PNG. Writing uses libpng's simplified API. Reading does not: that API hands 16-bit files out in linear light only,
// which loses the darks, and takes a 16-bit file without a gAMA chunk for linear.
#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/image/codecs.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstring>

namespace lightsweep {
namespace {

/// libpng reports an error by longjmp: the functions below that call setjmp own nothing with a destructor.
class PngDecoder {
  public:
    explicit PngDecoder(const std::string& bytes) : next_(bytes.data()), left_(bytes.size()) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        CHECK(png_ != nullptr);
        info_ = png_create_info_struct(png_);
        CHECK(info_ != nullptr);
        png_set_read_fn(png_, this, on_read);
    }
    ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngDecoder(const PngDecoder&) = delete;
    PngDecoder& operator=(const PngDecoder&) = delete;

    bool read_header() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_info(png_, info_);
        stored_row_bytes = png_get_rowbytes(png_, info_);
        width = png_get_image_width(png_, info_);
        height = png_get_image_height(png_, info_);
        return true;
    }

    /// Each row receives 8 * width bytes: big-endian 16-bit RGBA, whatever the file stores.
    bool read_rows(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_expand_16(png_);  // palettes, grey below 8 bits and transparent colours too
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        CHECK(png_get_rowbytes(png_, info_) == size_t{8} * width);
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    uint32_t width = 0;
    uint32_t height = 0;
    size_t stored_row_bytes = 0;
    char error[128] = "";

  private:
    static void on_read(png_structp png, png_bytep to, size_t count) {
        auto& self = *static_cast<PngDecoder*>(png_get_io_ptr(png));
        if (count > self.left_) png_error(png, "the file ends too early");
        std::memcpy(to, self.next_, count);
        self.next_ += count;
        self.left_ -= count;
    }
    static void on_error(png_structp png, png_const_charp message) {
        auto& self = *static_cast<PngDecoder*>(png_get_error_ptr(png));
        std::strncpy(self.error, message, sizeof self.error - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}  // a picture that can be read is read

    const char* next_;
    size_t left_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

/// `rgba`: 4 big-endian 16-bit values. Covering black by `alpha` scales light, not the encoded value.
void composite_over_black(const unsigned char* rgba, float* rgb) {
    const auto value = [&](int channel) {
        return static_cast<float>(rgba[2 * channel] << 8 | rgba[2 * channel + 1]) / 65535.0F;
    };
    const float alpha = value(3);
    for (int c = 0; c < 3; ++c) rgb[c] = alpha == 1.0F ? value(c) : linear_to_srgb(alpha * srgb_to_linear(value(c)));
}

// `format`: one of libpng's PNG_FORMAT_*, whose rows stand in `pixels` without padding.
std::string encode(int width, int height, png_uint_32 format, const void* pixels, const std::string& name) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width);
    png.height = static_cast<png_uint_32>(height);
    png.format = format;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
        throw InputError(name, fmt::format("cannot be encoded as PNG: {}", png.message));
    bytes.resize(size);
    return bytes;
}

}  // namespace

Image decode_png(const std::string& bytes, const std::string& name) {
    constexpr size_t kSignatureBytes = 8;
    if (bytes.size() < kSignatureBytes ||
        png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, kSignatureBytes) != 0)
        throw InputError(name, "is not a PNG file");

    PngDecoder png(bytes);
    const auto fail = [&] { throw InputError(name, fmt::format("is a damaged PNG file: {}", png.error)); };
    if (!png.read_header()) fail();
    if (int64_t{png.width} * png.height > kMaxFilePixels)
        throw InputError(
            name, fmt::format("{}x{} is too large; allowed: up to {} pixels", png.width, png.height, kMaxFilePixels));
    // Deflate expands by 1032 at most (zlib's technical notes): a short file with a large header is not worth its
    // memory.
    if ((png.stored_row_bytes + 1) * png.height / 1032 > bytes.size())
        throw InputError(name, fmt::format("is a damaged PNG file: too short for {}x{}", png.width, png.height));

    const size_t row_bytes = size_t{8} * png.width;
    std::vector<unsigned char> rgba(row_bytes * png.height);
    std::vector<png_bytep> rows(png.height);
    for (size_t y = 0; y < rows.size(); ++y) rows[y] = rgba.data() + y * row_bytes;
    if (!png.read_rows(rows.data())) fail();

    Image image(static_cast<int>(png.width), static_cast<int>(png.height), ColorSpace::display);
    for (size_t i = 0; i < image.pixel_count(); ++i) composite_over_black(&rgba[8 * i], &image.rgb[3 * i]);
    return image;
}

std::string encode_png(const Image& image, const std::string& name) {
    CHECK(image.space == ColorSpace::display);
    std::vector<unsigned char> rgb(image.rgb.size());
    std::ranges::transform(image.rgb, rgb.begin(), [](float v) {
        const float clamped = v > 0.0F ? std::min(v, 1.0F) : 0.0F;  // NaN compares false
        return static_cast<unsigned char>(std::floor(clamped * 255.0F + 0.5F));
    });

    return encode(image.width, image.height, PNG_FORMAT_RGB, rgb.data(), name);
}

std::string encode_grey16_png(int width, int height, std::span<const uint16_t> grey, const std::string& name) {
    return encode(width, height, PNG_FORMAT_LINEAR_Y, grey.data(), name);
}

}  // namespace lightsweep
