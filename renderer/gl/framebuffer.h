// Framebuffers: which textures a pass writes.
#pragma once

#include "renderer/gl/texture.h"

#include <glm/glm.hpp>

#include <span>
#include <string>

namespace lightsweep::gl {

namespace detail {
void delete_framebuffer(unsigned id);
}

class Framebuffer {
  public:
    Framebuffer() = default;
    /// Colour attachment i is `colors[i]`; `depth` may be null. Throws EnvironmentError when the device refuses the
    /// combination, naming the formats.
    Framebuffer(std::span<const Texture* const> colors, const Texture* depth, const std::string& label);

    void bind() const;  ///< for drawing; the viewport becomes the whole target
    void clear_color(int index, const glm::vec4& value) const;
    void clear_color_uint(int index, const glm::uvec4& value) const;
    void clear_depth(float value) const;
    void clear_stencil(int value) const;
    void clear_depth_stencil(float depth, int stencil) const;
    /// Tells the driver that the old content of attachment `index` (-1: depth and stencil) is not needed.
    void invalidate(int index) const;

    unsigned id() const { return handle_.id(); }

  private:
    Handle<detail::delete_framebuffer> handle_;
    int width_ = 0;
    int height_ = 0;
    bool stencil_ = false;
};

}  // namespace lightsweep::gl
