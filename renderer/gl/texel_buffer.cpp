#include "renderer/gl/texel_buffer.h"

#include "renderer/base/error.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>

namespace lightsweep::gl {

void detail::delete_buffer_texture(unsigned id) { glDeleteTextures(1, &id); }

TexelBuffer::TexelBuffer(Buffer buffer, Format format) : buffer_(std::move(buffer)), format_(format) {
    check_limit(buffer_.size_bytes() / info(format_).bytes);
    attach();
}

// The storage may have grown beyond what the device can address: then the texture is its first part.
void TexelBuffer::attach() {
    const size_t texel_bytes = info(format_).bytes;
    const auto limit = static_cast<size_t>(Context::current()->limits().max_texel_buffer_texels);
    const size_t texels = std::min(buffer_.size_bytes() / texel_bytes, limit);
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    texture_ = Handle<detail::delete_buffer_texture>(id);
    glTextureBufferRange(id, info(format_).gl_internal_format, buffer_.id(), 0,
                         static_cast<GLsizeiptr>(texels * texel_bytes));
    glObjectLabel(GL_TEXTURE, id, -1, buffer_.label().c_str());
}

void TexelBuffer::check_limit(size_t texels) const {
    const auto limit = static_cast<size_t>(Context::current()->limits().max_texel_buffer_texels);
    if (texels > limit) {
        throw EnvironmentError(fmt::format("buffer '{}' of {} texels is larger than max_texel_buffer_texels, {}",
                                           buffer_.label(), texels, limit));
    }
}

void TexelBuffer::write(std::span<const std::byte> content) {
    check_limit(content.size() / info(format_).bytes);
    const unsigned before = buffer_.id();
    buffer_.write(content);
    if (buffer_.id() != before) attach();
}

void TexelBuffer::reserve(size_t texels) {
    check_limit(texels);
    const unsigned before = buffer_.id();
    buffer_.reserve(texels * info(format_).bytes);
    if (buffer_.id() != before) attach();
}

void TexelBuffer::bind(unsigned unit) const { glBindTextureUnit(unit, texture_.id()); }

}  // namespace lightsweep::gl
