#include "renderer/gl/texel_buffer.h"

#include "renderer/base/error.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>
#include <glad/gl.h>

namespace lightsweep::gl {

void detail::delete_buffer_texture(unsigned id) { glDeleteTextures(1, &id); }

TexelBuffer::TexelBuffer(Buffer buffer, Format format) : buffer_(std::move(buffer)), format_(format) { attach(); }

void TexelBuffer::attach() {
    const auto limit = static_cast<size_t>(Context::current()->limits().max_texel_buffer_texels);
    const size_t texels = buffer_.size_bytes() / info(format_).bytes;
    if (texels > limit) {
        throw EnvironmentError(fmt::format("buffer '{}' of {} texels is larger than this device's limit of {}",
                                           buffer_.label(), texels, limit));
    }
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    texture_ = Handle<detail::delete_buffer_texture>(id);
    glTextureBuffer(id, info(format_).gl_internal_format, buffer_.id());
    glObjectLabel(GL_TEXTURE, id, -1, buffer_.label().c_str());
}

void TexelBuffer::write(std::span<const std::byte> content) {
    const unsigned before = buffer_.id();
    buffer_.write(content);
    if (buffer_.id() != before) attach();
}

void TexelBuffer::bind(unsigned unit) const { glBindTextureUnit(unit, texture_.id()); }

}  // namespace lightsweep::gl
