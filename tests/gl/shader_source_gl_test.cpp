// What the unit tests take for granted: a real compiler counts the lines of the text as the loader does.
#include "renderer/gl/context.h"
#include "renderer/gl/shader_source.h"

#include <glad/gl.h>
#include <gmock/gmock.h>

namespace lightsweep::gl {
namespace {

std::string compile_log(const ShaderSource& source) {
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
    const char* const text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    glDeleteShader(shader);
    log.resize(static_cast<size_t>(length));
    return map_log(log, source);
}

class ShaderSourceOnDevice : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Device, ShaderSourceOnDevice, testing::Values("surfaceless", "osmesa"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(ShaderSourceOnDevice, CompilerErrorsNameTheOriginalLine) {
    Context* const previous = Context::current();
    {
        const auto context = Context::create(GetParam());
        const std::vector<std::string> defines = {"ONE", "RED vec4(1, 0, 0, 1)"};
        std::map<std::string, std::string> files = {
            {"main.frag.glsl",
             "#include \"lib/good.glsl\"\n"
             "out vec4 color;\n"
             "void main() { color = good(); }\n"},
            {"lib/good.glsl", "#include \"lib/deep.glsl\"\nvec4 good() { return deep(); }\n"},
            {"lib/deep.glsl", "vec4 deep() { return RED; }\n"},
        };
        EXPECT_EQ(compile_log(load_shader("main.frag.glsl", defines, files)), "");
        files["lib/deep.glsl"] = "\n\nvec4 deep() { return wrong_in_deep; }\n";
        EXPECT_THAT(compile_log(load_shader("main.frag.glsl", defines, files)),
                    testing::StartsWith("lib/deep.glsl:3:"));
        files["lib/deep.glsl"] = "vec4 deep() { return RED; }\n";
        files["main.frag.glsl"] += "\nvec4 after() { return wrong_after_the_includes; }\n";
        EXPECT_THAT(compile_log(load_shader("main.frag.glsl", defines, files)),
                    testing::StartsWith("main.frag.glsl:5:"));
        EXPECT_THAT(context->take_debug_errors(), testing::IsEmpty()) << "the compiler's log is not a GL error";
    }
    if (previous) previous->make_current();
}

}  // namespace
}  // namespace lightsweep::gl
