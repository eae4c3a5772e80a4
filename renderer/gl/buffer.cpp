#include "renderer/gl/buffer.h"

#include "renderer/base/check.h"

#include <glad/gl.h>

#include <algorithm>
#include <vector>

namespace lightsweep::gl {

// Every binding of std430 and std140 wants a buffer with something in it.
constexpr size_t kSmallestBuffer = 16;

void detail::delete_buffer(unsigned id) { glDeleteBuffers(1, &id); }

namespace {

unsigned create(size_t size, const void* content, unsigned flags, const std::string& label) {
    unsigned id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(size), content, flags);
    glObjectLabel(GL_BUFFER, id, -1, label.c_str());
    return id;
}

}  // namespace

Buffer::Buffer(std::span<const std::byte> content, const std::string& label) : label_(label) {
    const std::vector<std::byte> zeros(content.empty() ? kSmallestBuffer : 0);
    const auto data = content.empty() ? std::span(zeros) : content;
    size_ = data.size();
    handle_ = Handle<detail::delete_buffer>(create(size_, data.data(), 0, label_));
}

Buffer::Buffer(size_t capacity, const std::string& label) : size_(std::max(capacity, kSmallestBuffer)), label_(label) {
    const std::vector<std::byte> zeros(size_);
    handle_ = Handle<detail::delete_buffer>(create(size_, zeros.data(), GL_DYNAMIC_STORAGE_BIT, label_));
}

void Buffer::write(std::span<const std::byte> content) {
    if (content.empty()) return;
    if (content.size() > size_) *this = Buffer(std::max(content.size(), size_ * 2), label_);
    glNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(content.size()), content.data());
}

void Buffer::bind_storage(unsigned slot) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, id()); }

void Buffer::bind_uniform(unsigned slot) const { glBindBufferBase(GL_UNIFORM_BUFFER, slot, id()); }

void Buffer::read(std::span<std::byte> target) const {
    CHECK_THAT(target.size() <= size_, "{} bytes from a buffer of {}", target.size(), size_);
    glGetNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(target.size()), target.data());
}

}  // namespace lightsweep::gl
