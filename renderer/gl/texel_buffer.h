// Buffers that shaders read texel by texel (`samplerBuffer`): large, read-only arrays. Software drivers fetch a whole
// texel at once, but read a storage buffer's words one by one and lane by lane.
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/format.h"

namespace lightsweep::gl {

namespace detail {
void delete_buffer_texture(unsigned id);
}

class TexelBuffer {
  public:
    TexelBuffer() = default;
    /// `format`: RGBA32F, R32UI or RG32UI. The buffer must be whole texels.
    TexelBuffer(Buffer buffer, Format format);

    /// As Buffer::write. Throws EnvironmentError when the content has more texels than the device can address.
    void write(std::span<const std::byte> content);
    template <class T>
    void write_items(std::span<const T> items) {
        write(std::as_bytes(items));
    }
    /// Makes room for at least this many texels. What was there is lost when that takes a new buffer. Throws as
    /// `write`.
    void reserve(size_t texels);
    /// To a texture unit.
    void bind(unsigned unit) const;
    /// For compute shaders that write it.
    const Buffer& buffer() const { return buffer_; }
    size_t size_bytes() const { return buffer_.size_bytes(); }

  private:
    void attach();
    void check_limit(size_t texels) const;

    Buffer buffer_;
    Format format_ = Format::RGBA32F;
    Handle<detail::delete_buffer_texture> texture_;
};

}  // namespace lightsweep::gl
