// A move-only owner of one GL name. Four bytes; empty (0) when moved from.
#pragma once

#include <utility>

namespace lightsweep::gl {

/// `Delete` frees the name; it is called once, with the context that made it current.
template <void (*Delete)(unsigned)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(unsigned id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0U)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0U);
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { reset(); }

    unsigned id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

  private:
    void reset() {
        if (id_ != 0) Delete(id_);
        id_ = 0;
    }
    unsigned id_ = 0;
};

}  // namespace lightsweep::gl
