#include "renderer/gl/framebuffer.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <vector>

namespace lightsweep::gl {

void detail::delete_framebuffer(unsigned id) { glDeleteFramebuffers(1, &id); }

Framebuffer::Framebuffer(std::span<const Texture* const> colors, const Texture* depth, const std::string& label) {
    int limit = 0;
    glGetIntegerv(GL_MAX_DRAW_BUFFERS, &limit);
    if (static_cast<int>(colors.size()) > limit) {
        throw EnvironmentError(
            fmt::format("{} needs {} colour targets; this device has {}", label, colors.size(), limit));
    }
    unsigned id = 0;
    glCreateFramebuffers(1, &id);
    handle_ = Handle<detail::delete_framebuffer>(id);
    std::vector<GLenum> draw_buffers;
    for (size_t i = 0; i < colors.size(); ++i) {
        draw_buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        glNamedFramebufferTexture(id, draw_buffers.back(), colors[i]->id(), 0);
    }
    glNamedFramebufferDrawBuffers(id, static_cast<int>(draw_buffers.size()), draw_buffers.data());
    if (depth != nullptr) {
        stencil_ = info(depth->format()).stencil;
        glNamedFramebufferTexture(id, stencil_ ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth->id(), 0);
    }
    const Texture* any = colors.empty() ? depth : colors.front();
    CHECK(any != nullptr);
    width_ = any->width();
    height_ = any->height();
    glObjectLabel(GL_FRAMEBUFFER, id, -1, label.c_str());
    if (const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
        status != GL_FRAMEBUFFER_COMPLETE) {
        std::string formats;
        for (const Texture* color : colors) formats += fmt::format(" {}", info(color->format()).name);
        if (depth != nullptr) formats += fmt::format(" {}", info(depth->format()).name);
        throw EnvironmentError(
            fmt::format("this device cannot render to{} together ({}, status 0x{:x})", formats, label, status));
    }
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id());
    glViewport(0, 0, width_, height_);
}

void Framebuffer::clear_color(int index, const glm::vec4& value) const {
    glClearNamedFramebufferfv(id(), GL_COLOR, index, &value.x);
}
void Framebuffer::clear_color_uint(int index, const glm::uvec4& value) const {
    glClearNamedFramebufferuiv(id(), GL_COLOR, index, &value.x);
}
void Framebuffer::clear_depth(float value) const { glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &value); }
void Framebuffer::clear_stencil(int value) const { glClearNamedFramebufferiv(id(), GL_STENCIL, 0, &value); }
void Framebuffer::clear_depth_stencil(float depth, int stencil) const {
    glClearNamedFramebufferfi(id(), GL_DEPTH_STENCIL, 0, depth, stencil);
}

void Framebuffer::invalidate(int index) const {
    const GLenum attachment = index >= 0 ? GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index)
                                         : (stencil_ ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT);
    glInvalidateNamedFramebufferData(id(), 1, &attachment);
}

}  // namespace lightsweep::gl
