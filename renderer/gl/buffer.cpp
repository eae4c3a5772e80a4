#include "renderer/gl/buffer.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"

#include <fmt/format.h>
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
    while (glGetError() != GL_NO_ERROR) {
    }
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(size), content, flags);
    if (glGetError() == GL_OUT_OF_MEMORY) {
        glDeleteBuffers(1, &id);
        throw EnvironmentError(fmt::format("no memory for buffer '{}' of {} bytes", label, size));
    }
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
    handle_ = Handle<detail::delete_buffer>(create(size_, nullptr, GL_DYNAMIC_STORAGE_BIT, label_));
    glClearNamedBufferData(id(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
}

void Buffer::write(std::span<const std::byte> content) {
    if (content.empty()) return;
    if (content.size() > size_) *this = Buffer(std::max(content.size(), size_ * 2), label_);
    glNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(content.size()), content.data());
}

void Buffer::reserve(size_t size_bytes) {
    if (size_bytes > size_) *this = Buffer(size_bytes, label_);
}

void Buffer::clear(size_t size_bytes) const {
    CHECK_THAT(size_bytes <= size_ && size_bytes % 4 == 0, "{} bytes of a buffer of {}", size_bytes, size_);
    glClearNamedBufferSubData(id(), GL_R32UI, 0, static_cast<GLsizeiptr>(size_bytes), GL_RED_INTEGER, GL_UNSIGNED_INT,
                              nullptr);
}

void Buffer::bind_storage(unsigned slot) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, id()); }

void Buffer::bind_uniform(unsigned slot) const { glBindBufferBase(GL_UNIFORM_BUFFER, slot, id()); }

void Buffer::read(std::span<std::byte> target) const {
    CHECK_THAT(target.size() <= size_, "{} bytes from a buffer of {}", target.size(), size_);
    glGetNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(target.size()), target.data());
}

}  // namespace lightsweep::gl
