// What `stress ulp` calls: functions of shaders/lib with inputs for them, and the same in double precision, written
// apart from the shaders' text. Data; no GL.
#pragma once

#include "bench/stress/shader_call.h"
#include "renderer/base/random.h"
#include "shaders/shared/types.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lightsweep {

/// A function of values.
struct ShaderFunction {
    std::string name;
    std::string domain;                 ///< of the inputs, in words
    std::vector<int> arguments;         ///< how many components of a, b, c, d it takes
    int components = 1;                 ///< of the result
    std::vector<std::string> includes;  ///< as ShaderCall's
    std::string body;
    std::vector<std::string> defines{};
    std::function<ShaderInput(Random&)> input;  ///< a random one
    std::vector<ShaderInput> special{};         ///< tried besides; alone where `input` is empty
    std::function<glm::dvec4(const ShaderInput&)> exact;
};

/// The frame constants that functions are called with (frame.glsl): a camera at the origin, reversed depth.
shared::FrameData call_frame();

/// Those of the driver first, as a baseline; then those of shaders/lib and of the encodings.
std::vector<ShaderFunction> shader_functions();

/// For encodings in 8 and 16 bits: a code decoded and encoded again is the same code (stored_codes.cpp).
std::vector<ShaderFunction> stored_codes();

}  // namespace lightsweep
