// 2-D textures: render targets and sampled images.
#pragma once

#include "renderer/gl/format.h"
#include "renderer/gl/handle.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lightsweep::gl {

namespace detail {
void delete_texture(unsigned id);
}

enum class Filter : uint8_t {
    nearest,    ///< render targets: texelFetch only
    trilinear,  ///< sampled images: all mip levels, repeated at the edges
};

struct TextureDesc {
    int width = 1;
    int height = 1;
    Format format = Format::RGBA8;
    Filter filter = Filter::nearest;
    std::string label;
};

class Texture {
  public:
    Texture() = default;
    /// Throws EnvironmentError when the device refuses the size or has no memory for it.
    explicit Texture(const TextureDesc& desc);

    /// Fills level 0 (rows in the order given, first row at t = 0) and makes the mip levels.
    void upload_rgba8(std::span<const uint8_t> rgba);
    /// Four floats for each texel of level 0; the format decides what is left of them.
    void upload_floats(std::span<const float> rgba);

    /// Blocking read of level 0 as floats, `components` per texel, first row at t = 0 (the bottom of a rendered image).
    /// Depth reads as one component; integer formats are not readable this way.
    std::vector<float> read_floats(int components) const;
    std::vector<uint8_t> read_rgba8() const;
    /// The same of an integer format.
    std::vector<uint32_t> read_uints(int components) const;

    void bind(unsigned unit) const;
    /// Tells the driver that the content is not needed any more.
    void invalidate() const;

    unsigned id() const { return handle_.id(); }
    int width() const { return width_; }
    int height() const { return height_; }
    Format format() const { return format_; }
    /// Of all levels, as a GPU stores them.
    size_t size_bytes() const;

  private:
    Handle<detail::delete_texture> handle_;
    int width_ = 0;
    int height_ = 0;
    int levels_ = 1;
    Format format_ = Format::RGBA8;
};

}  // namespace lightsweep::gl
