// What the device allows: read once per context, checked before a size or a count is asked of it, shown by `doctor`.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace lightsweep::gl {

struct Limits {
    int64_t max_texture_size_px = 0;
    int64_t max_framebuffer_width_px = 0;
    int64_t max_framebuffer_height_px = 0;
    int64_t max_array_texture_layers = 0;
    int64_t max_color_attachments = 0;
    int64_t max_draw_buffers = 0;
    int64_t max_samples = 0;
    int64_t max_texture_units = 0;  ///< per fragment shader
    int64_t max_image_units = 0;
    int64_t max_uniform_block_bytes = 0;
    int64_t max_texel_buffer_texels = 0;  ///< lights are three texels each
    int64_t max_storage_block_bytes = 0;
    int64_t max_storage_bindings = 0;
    int64_t uniform_offset_alignment_bytes = 0;
    int64_t storage_offset_alignment_bytes = 0;
    int64_t max_compute_invocations = 0;  ///< per work group
    int64_t max_compute_shared_bytes = 0;
    int64_t max_compute_groups = 0;  ///< work groups in the x direction of a dispatch
    int64_t max_loop_rounds = 0;     ///< of a shader's loops together: some drivers end them then, without a word
    int64_t subpixel_bits = 0;
    int64_t time_elapsed_bits = 0;  ///< GL_QUERY_COUNTER_BITS; 0 means that the query does not count at all
    int64_t timestamp_bits = 0;
};

/// Reads the limits of the current context, and finds out max_loop_rounds by letting a shader count.
Limits query_limits();

/// Name and value of every limit, in the order of the struct.
std::vector<std::pair<std::string_view, int64_t>> named_limits(const Limits& limits);

}  // namespace lightsweep::gl
