#include "renderer/gl/library.h"

#include "renderer/base/error.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <utility>

namespace lightsweep::gl {

Library::Library(const std::string& name, const std::string& cure) : name_(name) {
    // RTLD_LOCAL: two GL libraries in one process define the same symbols and must not see each other's.
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle_) throw EnvironmentError(fmt::format("cannot load {}; {}", dlerror(), cure));
}

Library::~Library() {
    if (handle_) dlclose(handle_);
}

Library::Library(Library&& other) noexcept
    : name_(std::move(other.name_)), handle_(std::exchange(other.handle_, nullptr)) {}

Library& Library::operator=(Library&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(handle_, other.handle_);
    return *this;
}

void* Library::address(const char* symbol) const {
    void* const found = handle_ ? dlsym(handle_, symbol) : nullptr;
    if (!found) throw EnvironmentError(fmt::format("{} has no function {}", name_, symbol));
    return found;
}

}  // namespace lightsweep::gl
