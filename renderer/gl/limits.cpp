#include "renderer/gl/limits.h"

#include <glad/gl.h>

#include <array>

namespace lightsweep::gl {
namespace {

struct LimitRow {
    std::string_view name;
    int64_t Limits::*value;
    GLenum query;
};

constexpr LimitRow kLimits[] = {
    {"max_texture_size_px", &Limits::max_texture_size_px, GL_MAX_TEXTURE_SIZE},
    {"max_framebuffer_width_px", &Limits::max_framebuffer_width_px, GL_MAX_FRAMEBUFFER_WIDTH},
    {"max_framebuffer_height_px", &Limits::max_framebuffer_height_px, GL_MAX_FRAMEBUFFER_HEIGHT},
    {"max_array_texture_layers", &Limits::max_array_texture_layers, GL_MAX_ARRAY_TEXTURE_LAYERS},
    {"max_color_attachments", &Limits::max_color_attachments, GL_MAX_COLOR_ATTACHMENTS},
    {"max_draw_buffers", &Limits::max_draw_buffers, GL_MAX_DRAW_BUFFERS},
    {"max_samples", &Limits::max_samples, GL_MAX_SAMPLES},
    {"max_texture_units", &Limits::max_texture_units, GL_MAX_TEXTURE_IMAGE_UNITS},
    {"max_image_units", &Limits::max_image_units, GL_MAX_IMAGE_UNITS},
    {"max_uniform_block_bytes", &Limits::max_uniform_block_bytes, GL_MAX_UNIFORM_BLOCK_SIZE},
    {"max_texel_buffer_texels", &Limits::max_texel_buffer_texels, GL_MAX_TEXTURE_BUFFER_SIZE},
    {"max_storage_block_bytes", &Limits::max_storage_block_bytes, GL_MAX_SHADER_STORAGE_BLOCK_SIZE},
    {"max_storage_bindings", &Limits::max_storage_bindings, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS},
    {"uniform_offset_alignment_bytes", &Limits::uniform_offset_alignment_bytes, GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT},
    {"storage_offset_alignment_bytes", &Limits::storage_offset_alignment_bytes,
     GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT},
    {"max_compute_invocations", &Limits::max_compute_invocations, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS},
    {"max_compute_shared_bytes", &Limits::max_compute_shared_bytes, GL_MAX_COMPUTE_SHARED_MEMORY_SIZE},
    {"subpixel_bits", &Limits::subpixel_bits, GL_SUBPIXEL_BITS},
};

// Query counters are asked per query target, not with glGet.
constexpr LimitRow kCounterBits[] = {
    {"time_elapsed_bits", &Limits::time_elapsed_bits, GL_TIME_ELAPSED},
    {"timestamp_bits", &Limits::timestamp_bits, GL_TIMESTAMP},
};

// One value for each direction.
constexpr LimitRow kFirstDirection[] = {
    {"max_compute_groups", &Limits::max_compute_groups, GL_MAX_COMPUTE_WORK_GROUP_COUNT},
};

// As many as any shader here makes for a million lights, and more; no device is asked for more.
constexpr GLuint kMostLoopRounds = 1U << 21;

// Not a limit that GL knows: a shader counts its rounds.
int64_t count_loop_rounds() {
    const char* text =
        "#version 450 core\n"
        "layout(local_size_x = 1) in;\n"
        "layout(std430, binding = 0) buffer Rounds { uint asked, made; };\n"
        "void main() {\n"
        "    uint count = 0u;\n"
        "    while (count < asked) ++count;\n"
        "    made = count;\n"
        "}\n";
    const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {  // nothing is known of such a limit
        glDeleteProgram(program);
        return kMostLoopRounds;
    }
    std::array<GLuint, 2> rounds{kMostLoopRounds, 0};
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, sizeof(rounds), rounds.data(), 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof(rounds), rounds.data());
    glUseProgram(0);
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);
    return rounds[1];
}

}  // namespace

Limits query_limits() {
    Limits limits;
    for (const LimitRow& row : kLimits) {
        GLint64 value = 0;
        glGetInteger64v(row.query, &value);
        limits.*row.value = value;
    }
    for (const LimitRow& row : kCounterBits) {
        GLint bits = 0;
        glGetQueryiv(row.query, GL_QUERY_COUNTER_BITS, &bits);
        limits.*row.value = bits;
    }
    for (const LimitRow& row : kFirstDirection) {
        GLint64 value = 0;
        glGetInteger64i_v(row.query, 0, &value);
        limits.*row.value = value;
    }
    limits.max_loop_rounds = count_loop_rounds();
    return limits;
}

std::vector<std::pair<std::string_view, int64_t>> named_limits(const Limits& limits) {
    std::vector<std::pair<std::string_view, int64_t>> named;
    for (const LimitRow& row : kLimits) named.emplace_back(row.name, limits.*row.value);
    for (const LimitRow& row : kCounterBits) named.emplace_back(row.name, limits.*row.value);
    for (const LimitRow& row : kFirstDirection) named.emplace_back(row.name, limits.*row.value);
    named.emplace_back("max_loop_rounds", limits.max_loop_rounds);
    return named;
}

}  // namespace lightsweep::gl
