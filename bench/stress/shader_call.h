// Functions of shaders/lib called on the GPU with arrays of values: for each row of inputs, one vec4 comes back.
#pragma once

#include "renderer/gl/program.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <vector>

namespace lightsweep {

/// The bits of these floats arrive in the shader as they are; a device may still flush denormals when it computes.
struct ShaderInput {
    glm::vec4 a{0.0F}, b{0.0F}, c{0.0F}, d{0.0F};
};

class ShaderCall {
  public:
    /// `includes`: files below shaders/ ("lib/brdf.glsl"). `body`: statements that read the vec4 a, b, c, d and set the
    /// vec4 `result`. `defines` as in gl::ProgramDesc. Functions that `body` needs besides go into `functions`.
    /// Throws std::runtime_error where that does not compile.
    ShaderCall(const std::vector<std::string>& includes, const std::string& body,
               const std::vector<std::string>& defines = {}, const std::string& functions = {});

    /// As many as `inputs`, in 32-bit floats.
    std::vector<glm::vec4> operator()(std::span<const ShaderInput> inputs) const;

  private:
    gl::Program program_;
};

}  // namespace lightsweep
