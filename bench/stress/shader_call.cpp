#include "bench/stress/shader_call.h"

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/state.h"
#include "renderer/gl/texture.h"
#include "shaders/shared/slots.h"

#include <array>

namespace lightsweep {
namespace {

constexpr size_t kColumns = 256;
constexpr size_t kArguments = 4;

std::string call_text(const std::vector<std::string>& includes, const std::string& body, const std::string& functions) {
    std::string text;
    for (const std::string& file : includes) text += "#include \"" + file + "\"\n";
    return text + functions + "\nvec4 call(vec4 a, vec4 b, vec4 c, vec4 d) {\n    vec4 result = vec4(0.0);\n" + body +
           "\n    return result;\n}\n";
}

}  // namespace

ShaderCall::ShaderCall(const std::vector<std::string>& includes, const std::string& body,
                       const std::vector<std::string>& defines, const std::string& functions)
    : program_({.vertex = "paths/fullscreen.vert.glsl",
                .fragment = "stress/call.frag.glsl",
                .defines = defines,
                .generated = {{"generated/call.glsl", call_text(includes, body, functions)}}}) {}

std::vector<glm::vec4> ShaderCall::operator()(std::span<const ShaderInput> inputs) const {
    if (inputs.empty()) return {};
    const size_t rows = (inputs.size() + kColumns - 1) / kColumns;
    const gl::TextureDesc desc{.width = kColumns,
                               .height = static_cast<int>(rows),
                               .format = gl::Format::RGBA32F,
                               .label = "values of a call"};
    std::array<gl::Texture, kArguments> arguments;
    std::vector<float> texels(rows * kColumns * 4);
    for (size_t k = 0; k < kArguments; ++k) {
        for (size_t i = 0; i < inputs.size(); ++i) {
            const std::array<glm::vec4, kArguments> values{inputs[i].a, inputs[i].b, inputs[i].c, inputs[i].d};
            for (int channel = 0; channel < 4; ++channel) texels[4 * i + channel] = values[k][channel];
        }
        arguments[k] = gl::Texture(desc);
        arguments[k].upload_floats(texels);
        arguments[k].bind(static_cast<unsigned>(shared::kTargetUnit) + static_cast<unsigned>(k));
    }
    const gl::Texture output(desc);
    const gl::Texture* target = &output;
    const gl::Framebuffer framebuffer(std::span(&target, 1), nullptr, "results of a call");
    framebuffer.bind();
    gl::apply(gl::RasterState{});
    const gl::VertexArray no_attributes({}, {}, "no attributes");
    no_attributes.bind();
    program_.use();
    gl::draw_triangles(3);
    const std::vector<float> values = output.read_floats(4);
    std::vector<glm::vec4> results(inputs.size());
    for (size_t i = 0; i < results.size(); ++i) {
        results[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
    }
    return results;
}

}  // namespace lightsweep
