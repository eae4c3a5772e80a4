// One variant on the GPU: values in, stored in the target's real format by the layout's own GLSL, and back as floats.
#pragma once

#include "bench/encodings/variant.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace lightsweep {

/// A texture of 32-bit floats, a vec4 for each pixel.
gl::Texture make_float_texture(int width, int height, const std::string& label);

std::vector<glm::vec4> read_pixels(const gl::Texture& float_texture);

class RoundTrip {
  public:
    RoundTrip(const Variant& variant, int width, int height);
    /// Issues the pass that reads `samples` and stores them. For depth: draws a point in each pixel.
    void encode(const gl::Texture& samples) const;
    /// Issues the pass that reads what is stored and writes it to `output` (of make_float_texture's format).
    void decode(const gl::Framebuffer& output) const;

  private:
    void draw_full_screen() const;

    bool is_depth_;
    gl::ClipDepth clip_;
    uint32_t pixels_;
    float depth_clear_;
    gl::Buffer constants_;
    gl::Texture target_;
    gl::Framebuffer framebuffer_;
    gl::Program encode_, decode_;
    gl::VertexArray no_attributes_;
};

/// What comes back of `samples`, one for each pixel of a target of `width` x `height`.
std::vector<glm::vec4> round_trip(const Variant& variant, std::span<const glm::vec4> samples, int width, int height);

}  // namespace lightsweep
