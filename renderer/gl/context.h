// An OpenGL 4.5 core context without a window, from EGL or OSMesa, with its debug output turned on and recorded.
// Knows nothing of what is drawn. One thread uses GL at a time: the loaded function pointers are process-wide.
#pragma once

#include "renderer/gl/limits.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep::gl {

struct ContextInfo {
    std::string provider;  ///< "egl_device", "egl_surfaceless" or "osmesa"
    std::string device;    ///< the key that gives this context again: "egl:0", "surfaceless", "osmesa"
    std::string
        vendor;  ///< GL_VENDOR, GL_RENDERER, GL_VERSION and GL_SHADING_LANGUAGE_VERSION, as the driver says them
    std::string renderer;
    std::string version;
    std::string glsl_version;
    bool software = false;  ///< rasterises on the CPU
    int major = 0;
    int minor = 0;
};

class Context {
  public:
    /// Makes a context and makes it current. `device` is a key:
    ///   "auto"         $LIGHTSWEEP_DEVICE when it is set, else the first EGL device that is hardware, else
    ///   surfaceless,
    ///                  else the first EGL device, else OSMesa
    ///   "egl:N"        the Nth device that EGL enumerates (not CUDA's order)
    ///   "surfaceless"  Mesa's surfaceless EGL platform
    ///   "osmesa"       OSMesa, loaded from libOSMesa.so.8
    /// Throws InputError when the key is none of these, EnvironmentError (what was tried, and the cure) when no
    /// OpenGL 4.5 core context comes of it. The context that was current stays current when it throws.
    static std::unique_ptr<Context> create(std::string_view device = "auto");

    /// Releases the context from its thread first when it is current. Objects made in it must be gone by then.
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// The context that make_current() was last called on in this thread; nullptr when there is none.
    static Context* current();

    /// Makes GL calls go to this context, function pointers included. Cheap when it is current already.
    void make_current();

    const ContextInfo& info() const;
    const Limits& limits() const;

    /// Debug messages are synchronous from the start: they arrive inside the call that causes them. A measurement may
    /// turn that off, so that the driver may check on a thread of its own. On llvmpipe tiny draws take at most 1.01
    /// times as long with output in either mode as without: below what can be told apart from noise. Needs this context
    /// current.
    void set_debug_synchronous(bool synchronous);

    /// The errors and high-severity messages since the last call, oldest first, at most 64; and forgets them.
    std::vector<std::string> take_debug_errors();

    /// Throws std::runtime_error naming `where` and the first error when there are any; forgets them.
    void throw_on_debug_errors(std::string_view where);

  private:
    struct Impl;
    explicit Context(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Throws EnvironmentError unless the ECMAScript regular expression matches somewhere in GL_RENDERER, ignoring case;
/// InputError when it is not a regular expression.
void require_renderer(const Context& context, const std::string& regex);

/// What `list devices` shows: a way of making a context, and what came of trying it.
struct DeviceInfo {
    std::string key;  ///< "egl:0", "surfaceless", "osmesa"
    bool available = false;
    std::string reason;    ///< why not, in one line; empty when available
    std::string renderer;  ///< empty when not available, like `version`
    std::string version;
    bool software = false;
};

/// Every EGL device, then surfaceless, then OSMesa, each probed by making a context and destroying it. Never throws for
/// a device that fails. The context that was current is current again afterwards.
std::vector<DeviceInfo> list_devices();

}  // namespace lightsweep::gl
