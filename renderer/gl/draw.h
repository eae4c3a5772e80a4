// Vertex arrays and the draw calls.
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/handle.h"

#include <cstdint>
#include <span>
#include <string>

namespace lightsweep::gl {

namespace detail {
void delete_vertex_array(unsigned id);
}

struct VertexAttribute {
    unsigned location;
    unsigned binding;
    int components;
    unsigned offset_bytes;
    bool integer = false;  ///< uint32 read as uint in the shader; else float
};

struct VertexBinding {
    unsigned binding;
    unsigned stride_bytes;
    unsigned divisor = 0;  ///< 1: advances once per instance
};

class VertexArray {
  public:
    VertexArray() = default;
    VertexArray(std::span<const VertexBinding> bindings, std::span<const VertexAttribute> attributes,
                const std::string& label);
    void set_buffer(const VertexBinding& binding, const Buffer& buffer) const;
    void set_indices(const Buffer& buffer) const;  ///< uint32
    void bind() const;

  private:
    Handle<detail::delete_vertex_array> handle_;
};

struct IndexedDraw {
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    uint32_t instance_count = 1;
    uint32_t first_instance = 0;  ///< offset into per-instance attributes
};
void draw_indexed(const IndexedDraw& draw);
void draw_triangles(uint32_t vertex_count);
void draw_points(uint32_t vertex_count);            ///< one pixel each
void dispatch(uint32_t x, uint32_t y, uint32_t z);  ///< work groups
/// Makes writes of compute shaders visible to everything after.
void memory_barrier();

void push_group(const std::string& label);  ///< KHR_debug group, seen by RenderDoc and apitrace
void pop_group();

void finish();
void flush();

}  // namespace lightsweep::gl
