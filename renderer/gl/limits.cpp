#include "renderer/gl/limits.h"

#include <glad/gl.h>

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
    return limits;
}

std::vector<std::pair<std::string_view, int64_t>> named_limits(const Limits& limits) {
    std::vector<std::pair<std::string_view, int64_t>> named;
    for (const LimitRow& row : kLimits) named.emplace_back(row.name, limits.*row.value);
    for (const LimitRow& row : kCounterBits) named.emplace_back(row.name, limits.*row.value);
    for (const LimitRow& row : kFirstDirection) named.emplace_back(row.name, limits.*row.value);
    return named;
}

}  // namespace lightsweep::gl
