// What EGL and OSMesa each give to context.cpp: a bare context of theirs. The only thing that differs between them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace lightsweep::gl {

using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);

enum class Request {
    core_4_5,  ///< what the program needs: OpenGL 4.5 core, debug flag where the provider has one
    any,       ///< whatever the driver gives, to name it in a message
};

class NativeContext {
  public:
    virtual ~NativeContext() = default;
    /// Throws EnvironmentError.
    virtual void make_current() = 0;
    /// Leaves the thread without a current context of this provider.
    virtual void release() = 0;
    /// The same function for every context of a provider: function pointers are valid as long as it stays the same.
    virtual GlLoader loader() const = 0;
};

/// For each EGL device in EGL's order, whether EGL itself calls it software. Throws EnvironmentError without EGL.
std::vector<bool> egl_device_software_flags();

/// All three throw EnvironmentError: what was tried, and the cure.
std::unique_ptr<NativeContext> create_egl_device_context(size_t index, Request request);
std::unique_ptr<NativeContext> create_egl_surfaceless_context(Request request);
std::unique_ptr<NativeContext> create_osmesa_context(Request request);

}  // namespace lightsweep::gl
