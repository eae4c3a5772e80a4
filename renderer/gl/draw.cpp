#include "renderer/gl/draw.h"

#include <glad/gl.h>

namespace lightsweep::gl {

void detail::delete_vertex_array(unsigned id) { glDeleteVertexArrays(1, &id); }

VertexArray::VertexArray(std::span<const VertexBinding> bindings, std::span<const VertexAttribute> attributes,
                         const std::string& label) {
    unsigned id = 0;
    glCreateVertexArrays(1, &id);
    handle_ = Handle<detail::delete_vertex_array>(id);
    for (const auto& a : attributes) {
        glEnableVertexArrayAttrib(id, a.location);
        glVertexArrayAttribBinding(id, a.location, a.binding);
        if (a.integer) {
            glVertexArrayAttribIFormat(id, a.location, a.components, GL_UNSIGNED_INT, a.offset_bytes);
        } else {
            glVertexArrayAttribFormat(id, a.location, a.components, GL_FLOAT, GL_FALSE, a.offset_bytes);
        }
    }
    for (const auto& b : bindings) glVertexArrayBindingDivisor(id, b.binding, b.divisor);
    glObjectLabel(GL_VERTEX_ARRAY, id, -1, label.c_str());
}

void VertexArray::set_buffer(const VertexBinding& binding, const Buffer& buffer) const {
    glVertexArrayVertexBuffer(handle_.id(), binding.binding, buffer.id(), 0, static_cast<int>(binding.stride_bytes));
}

void VertexArray::set_indices(const Buffer& buffer) const { glVertexArrayElementBuffer(handle_.id(), buffer.id()); }

void VertexArray::bind() const { glBindVertexArray(handle_.id()); }

void draw_indexed(const IndexedDraw& draw) {
    // The offset into the index buffer travels as a pointer: an old habit of this entry point.
    const auto* offset = static_cast<const char*>(nullptr) + size_t{draw.first_index} * sizeof(uint32_t);
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<int>(draw.index_count), GL_UNSIGNED_INT, offset,
                                        static_cast<int>(draw.instance_count), draw.first_instance);
}

void draw_triangles(uint32_t vertex_count) { glDrawArrays(GL_TRIANGLES, 0, static_cast<int>(vertex_count)); }

void draw_points(uint32_t vertex_count) { glDrawArrays(GL_POINTS, 0, static_cast<int>(vertex_count)); }

void dispatch(uint32_t x, uint32_t y, uint32_t z) { glDispatchCompute(x, y, z); }

void memory_barrier() { glMemoryBarrier(GL_ALL_BARRIER_BITS); }

void push_group(const std::string& label) { glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, label.c_str()); }
void pop_group() { glPopDebugGroup(); }

void finish() { glFinish(); }
void flush() { glFlush(); }

}  // namespace lightsweep::gl
