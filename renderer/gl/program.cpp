#include "renderer/gl/program.h"

#include "renderer/gl/shader_source.h"

#include <glad/gl.h>

#include <stdexcept>

namespace lightsweep::gl {

void detail::delete_program(unsigned id) { glDeleteProgram(id); }

namespace {

void delete_shader(unsigned id) { glDeleteShader(id); }

Handle<delete_shader> compile(GLenum stage, const std::string& name, const ProgramDesc& desc) {
    const ShaderSource source = load_shader(name, desc.defines, desc.generated);
    Handle<delete_shader> shader(glCreateShader(stage));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glObjectLabel(GL_SHADER, shader.id(), -1, name.c_str());
    glCompileShader(shader.id());
    int compiled = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        int length = 0;
        glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<size_t>(length), '\0');
        glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
        throw std::runtime_error("shader " + name + " does not compile:\n" + map_log(log, source));
    }
    return shader;
}

}  // namespace

Program::Program(const ProgramDesc& desc) : handle_(glCreateProgram()) {
    std::vector<Handle<delete_shader>> shaders;
    const auto attach = [&](GLenum stage, const std::string& name) {
        if (name.empty()) return;
        shaders.push_back(compile(stage, name, desc));
        glAttachShader(id(), shaders.back().id());
    };
    attach(GL_VERTEX_SHADER, desc.vertex);
    attach(GL_FRAGMENT_SHADER, desc.fragment);
    attach(GL_COMPUTE_SHADER, desc.compute);
    const std::string label = desc.compute.empty() ? desc.vertex + "+" + desc.fragment : desc.compute;
    glObjectLabel(GL_PROGRAM, id(), -1, label.c_str());
    glLinkProgram(id());
    for (const auto& shader : shaders) glDetachShader(id(), shader.id());
    int linked = 0;
    glGetProgramiv(id(), GL_LINK_STATUS, &linked);
    if (linked == 0) {
        int length = 0;
        glGetProgramiv(id(), GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<size_t>(length), '\0');
        glGetProgramInfoLog(id(), length, nullptr, log.data());
        throw std::runtime_error("program " + label + " does not link:\n" + log);
    }
}

void Program::use() const { glUseProgram(id()); }
void Program::set_uint(int location, unsigned value) const { glProgramUniform1ui(id(), location, value); }
void Program::set_float(int location, float value) const { glProgramUniform1f(id(), location, value); }

}  // namespace lightsweep::gl
