#include "renderer/gl/texture.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <bit>

namespace lightsweep::gl {

void detail::delete_texture(unsigned id) { glDeleteTextures(1, &id); }

Texture::Texture(const TextureDesc& desc) : width_(desc.width), height_(desc.height), format_(desc.format) {
    int limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width_ > limit || height_ > limit) {
        throw EnvironmentError(fmt::format("target '{}' of {}x{} px is larger than this device's limit of {} px",
                                           desc.label, width_, height_, limit));
    }
    CHECK_THAT(width_ > 0 && height_ > 0, "{}x{}", width_, height_);
    const bool mipmapped = desc.filter == Filter::trilinear;
    if (mipmapped) levels_ = std::bit_width(static_cast<unsigned>(std::max(width_, height_)));
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    handle_ = Handle<detail::delete_texture>(id);
    while (glGetError() != GL_NO_ERROR) {
    }
    glTextureStorage2D(id, levels_, info(format_).gl_internal_format, width_, height_);
    if (glGetError() == GL_OUT_OF_MEMORY) {
        throw EnvironmentError(
            fmt::format("no memory for target '{}' ({}x{} px, {})", desc.label, width_, height_, info(format_).name));
    }
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, mipmapped ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, mipmapped ? GL_LINEAR : GL_NEAREST);
    const int wrap = mipmapped ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, wrap);
    glObjectLabel(GL_TEXTURE, id, -1, desc.label.c_str());
}

void Texture::upload_rgba8(std::span<const uint8_t> rgba) {
    CHECK_THAT(rgba.size() == size_t{4} * width_ * height_, "{} bytes for {}x{}", rgba.size(), width_, height_);
    glTextureSubImage2D(id(), 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    if (levels_ > 1) glGenerateTextureMipmap(id());
}

void Texture::upload_floats(std::span<const float> rgba) {
    CHECK_THAT(rgba.size() == size_t{4} * width_ * height_, "{} floats for {}x{}", rgba.size(), width_, height_);
    glTextureSubImage2D(id(), 0, 0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba.data());
}

std::vector<float> Texture::read_floats(int components) const {
    CHECK(info(format_).kind != FormatKind::uint);
    static constexpr GLenum kFormats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    CHECK_THAT(components >= 1 && components <= 4, "{}", components);
    const bool depth = info(format_).kind == FormatKind::depth;
    std::vector<float> result(static_cast<size_t>(components) * width_ * height_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(id(), 0, depth ? GL_DEPTH_COMPONENT : kFormats[components - 1], GL_FLOAT,
                      static_cast<int>(result.size() * sizeof(float)), result.data());
    return result;
}

std::vector<uint8_t> Texture::read_rgba8() const {
    std::vector<uint8_t> result(size_t{4} * width_ * height_);
    glGetTextureImage(id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<int>(result.size()), result.data());
    return result;
}

std::vector<uint32_t> Texture::read_uints(int components) const {
    CHECK(info(format_).kind == FormatKind::uint);
    static constexpr GLenum kFormats[] = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER, GL_RGBA_INTEGER};
    CHECK_THAT(components >= 1 && components <= 4, "{}", components);
    std::vector<uint32_t> result(static_cast<size_t>(components) * width_ * height_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(id(), 0, kFormats[components - 1], GL_UNSIGNED_INT,
                      static_cast<int>(result.size() * sizeof(uint32_t)), result.data());
    return result;
}

void Texture::invalidate() const {
    for (int level = 0; level < levels_; ++level) glInvalidateTexImage(id(), level);
}

void Texture::bind(unsigned unit) const { glBindTextureUnit(unit, id()); }

size_t Texture::size_bytes() const {
    size_t bytes = 0;
    for (int level = 0; level < levels_; ++level) {
        bytes += size_t{info(format_).bytes} * std::max(1, width_ >> level) * std::max(1, height_ >> level);
    }
    return bytes;
}

}  // namespace lightsweep::gl
