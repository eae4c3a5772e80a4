// GL buffers: immutable storage, direct state access.
#pragma once

#include "renderer/gl/handle.h"

#include <cstddef>
#include <span>
#include <string>

namespace lightsweep::gl {

namespace detail {
void delete_buffer(unsigned id);
}

class Buffer {
  public:
    Buffer() = default;
    /// Storage that the CPU fills once. An empty span gives a buffer of 16 zero bytes, so that it can always be bound.
    Buffer(std::span<const std::byte> content, const std::string& label);
    /// Storage of at least `capacity` bytes that `write` refills.
    Buffer(size_t capacity, const std::string& label);

    /// Replaces the first bytes, after the GPU is done with the old ones (the driver keeps order). Grows the storage
    /// when it is too small: the name changes then, so bind after writing.
    void write(std::span<const std::byte> content);
    template <class T>
    void write_items(std::span<const T> items) {
        write(std::as_bytes(items));
    }
    /// Makes the storage at least this large; a larger one starts as zeros, and has a new name. Throws EnvironmentError
    /// when the device has no memory for it.
    void reserve(size_t size_bytes);
    /// Zeros the first bytes on the GPU, in order with everything else; a multiple of 4.
    void clear(size_t size_bytes) const;

    void bind_storage(unsigned slot) const;
    void bind_uniform(unsigned slot) const;
    /// Blocking read of `size` bytes from the start.
    void read(std::span<std::byte> target) const;

    unsigned id() const { return handle_.id(); }
    size_t size_bytes() const { return size_; }
    const std::string& label() const { return label_; }

  private:
    Handle<detail::delete_buffer> handle_;
    size_t size_ = 0;
    std::string label_;
};

}  // namespace lightsweep::gl
