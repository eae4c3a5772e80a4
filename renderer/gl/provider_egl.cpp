// EGL without a window: a device by its number (EGL_EXT_platform_device), or Mesa's surfaceless platform.
#define EGL_NO_X11
#include "renderer/base/error.h"
#include "renderer/gl/library.h"
#include "renderer/gl/provider_internal.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

namespace lightsweep::gl {
namespace {

constexpr const char* kDriverCure = "install libegl-mesa0 (Debian) or the GPU vendor's EGL driver";

// Whether a space-separated list of extensions (nullptr: none) has this one as a whole word.
bool has_extension(const char* extensions, std::string_view extension) {
    return extensions && fmt::format(" {} ", extensions).find(fmt::format(" {} ", extension)) != std::string::npos;
}

struct Egl {
    Library library{"libEGL.so.1", "install libegl1 (Debian)"};
    PFNEGLGETPROCADDRESSPROC get_proc_address = library.function<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
    PFNEGLGETERRORPROC get_error = library.function<PFNEGLGETERRORPROC>("eglGetError");
    PFNEGLQUERYSTRINGPROC query_string = library.function<PFNEGLQUERYSTRINGPROC>("eglQueryString");
    PFNEGLINITIALIZEPROC initialize = library.function<PFNEGLINITIALIZEPROC>("eglInitialize");
    PFNEGLTERMINATEPROC terminate = library.function<PFNEGLTERMINATEPROC>("eglTerminate");
    PFNEGLBINDAPIPROC bind_api = library.function<PFNEGLBINDAPIPROC>("eglBindAPI");
    PFNEGLCHOOSECONFIGPROC choose_config = library.function<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig");
    PFNEGLCREATECONTEXTPROC create_context = library.function<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
    PFNEGLDESTROYCONTEXTPROC destroy_context = library.function<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext");
    PFNEGLCREATEPBUFFERSURFACEPROC create_pbuffer =
        library.function<PFNEGLCREATEPBUFFERSURFACEPROC>("eglCreatePbufferSurface");
    PFNEGLDESTROYSURFACEPROC destroy_surface = library.function<PFNEGLDESTROYSURFACEPROC>("eglDestroySurface");
    PFNEGLMAKECURRENTPROC make_current = library.function<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");

    bool has_client_extension(std::string_view extension) const {
        return has_extension(query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS), extension);
    }
    template <typename Function>
    Function extension_function(const char* name) const {
        const auto function = reinterpret_cast<Function>(get_proc_address(name));
        if (!function) throw EnvironmentError(fmt::format("EGL has no {}; {}", name, kDriverCure));
        return function;
    }
    [[noreturn]] void fail(const std::string& where, std::string_view call) const {
        throw EnvironmentError(fmt::format("{}: {} failed (EGL error {:#06x})", where, call, get_error()));
    }
};

const Egl& egl() {
    // Never unloaded: drivers leave threads and thread-local destructors behind that run until the process ends.
    static const Egl* const library = new Egl;
    return *library;
}

// An initialized display. EGL gives every caller the same display for the same device, and terminating it destroys all
// of its contexts: so those who use one at the same time share it, and the last one terminates it.
class Display {
  public:
    static std::shared_ptr<Display> open(const std::string& where, EGLenum platform, void* native) {
        const auto get_display = egl().extension_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
        const EGLDisplay handle = get_display(platform, native, nullptr);
        if (handle == EGL_NO_DISPLAY)
            throw EnvironmentError(fmt::format("{}: no EGL driver offers it; {}", where, kDriverCure));
        static std::map<EGLDisplay, std::weak_ptr<Display>> open_displays;
        std::weak_ptr<Display>& slot = open_displays[handle];
        std::shared_ptr<Display> display = slot.lock();
        if (!display) slot = display = std::shared_ptr<Display>(new Display(where, handle));
        return display;
    }
    ~Display() { egl().terminate(handle_); }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    EGLDisplay handle() const { return handle_; }
    /// EGL 1.5, where the version, profile and debug flag of a context can be asked for. Mesa says 1.4 when its
    /// rasteriser is too weak, whatever the library is.
    bool has_context_versions() const { return has_context_versions_; }
    bool has_extension(std::string_view extension) const {
        return gl::has_extension(egl().query_string(handle_, EGL_EXTENSIONS), extension);
    }

  private:
    Display(const std::string& where, EGLDisplay handle) : handle_(handle) {
        EGLint major = 0, minor = 0;
        if (!egl().initialize(handle, &major, &minor)) egl().fail(where, "eglInitialize");
        has_context_versions_ = major > 1 || minor >= 5;
    }

    EGLDisplay handle_;
    bool has_context_versions_ = false;
};

class EglContext : public NativeContext {
  public:
    EglContext(const std::string& where, std::shared_ptr<Display> display, Request request)
        : where_(where), display_(std::move(display)) {
        if (request == Request::core_4_5 && !display_->has_context_versions())
            throw EnvironmentError(fmt::format("{}: no OpenGL 4.5 core, as EGL offers less than 1.5", where));
        if (!egl().bind_api(EGL_OPENGL_API)) egl().fail(where, "eglBindAPI(EGL_OPENGL_API)");
        const bool needs_surface = !display_->has_extension("EGL_KHR_surfaceless_context");
        const bool needs_config = needs_surface || !display_->has_extension("EGL_KHR_no_config_context");
        const EGLConfig config = needs_config ? choose_config() : EGL_NO_CONFIG_KHR;
        if (needs_surface) {
            static constexpr EGLint kOnePixel[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
            surface_ = egl().create_pbuffer(display_->handle(), config, kOnePixel);
            if (surface_ == EGL_NO_SURFACE) egl().fail(where, "eglCreatePbufferSurface");
        }
        static constexpr EGLint kAny[] = {EGL_NONE};
        static constexpr EGLint kCore[] = {EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           EGL_TRUE,
                                           EGL_NONE};
        context_ = egl().create_context(display_->handle(), config, EGL_NO_CONTEXT,
                                        request == Request::core_4_5 ? kCore : kAny);
        if (context_ == EGL_NO_CONTEXT) {
            destroy_surface();
            egl().fail(where, "eglCreateContext(OpenGL 4.5 core)");
        }
    }
    ~EglContext() override {
        egl().destroy_context(display_->handle(), context_);
        destroy_surface();
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void make_current() override {
        if (!egl().make_current(display_->handle(), surface_, surface_, context_)) egl().fail(where_, "eglMakeCurrent");
    }
    void release() override { egl().make_current(display_->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    GlLoader loader() const override { return egl().get_proc_address; }

  private:
    EGLConfig choose_config() const {
        static constexpr EGLint kWanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                             EGL_NONE};
        EGLConfig config = EGL_NO_CONFIG_KHR;
        EGLint count = 0;
        if (!egl().choose_config(display_->handle(), kWanted, &config, 1, &count) || count == 0)
            egl().fail(where_, "eglChooseConfig(pbuffer, OpenGL)");
        return config;
    }
    void destroy_surface() {
        if (surface_ != EGL_NO_SURFACE) egl().destroy_surface(display_->handle(), surface_);
    }

    std::string where_;
    std::shared_ptr<Display> display_;
    EGLSurface surface_ = EGL_NO_SURFACE;
    EGLContext context_ = EGL_NO_CONTEXT;
};

std::vector<EGLDeviceEXT> enumerate_devices() {
    if (!egl().has_client_extension("EGL_EXT_platform_device")) return {};
    const auto query = egl().extension_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!query(0, nullptr, &count)) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
    if (count > 0 && !query(count, devices.data(), &count)) return {};
    devices.resize(static_cast<size_t>(count));
    return devices;
}

}  // namespace

std::vector<bool> egl_device_software_flags() {
    const std::vector<EGLDeviceEXT> devices = enumerate_devices();
    std::vector<bool> software;
    if (devices.empty()) return software;
    const auto query_string = egl().extension_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    for (const EGLDeviceEXT device : devices)
        software.push_back(has_extension(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software"));
    return software;
}

std::unique_ptr<NativeContext> create_egl_device_context(size_t index, Request request) {
    const std::string where = fmt::format("egl:{}", index);
    const std::vector<EGLDeviceEXT> devices = enumerate_devices();
    if (devices.empty()) throw EnvironmentError(fmt::format("{}: EGL finds no device; {}", where, kDriverCure));
    if (index >= devices.size())
        throw EnvironmentError(fmt::format("{}: EGL finds {} device{}, egl:0 to egl:{}", where, devices.size(),
                                           devices.size() == 1 ? "" : "s", devices.size() - 1));
    return std::make_unique<EglContext>(where, Display::open(where, EGL_PLATFORM_DEVICE_EXT, devices[index]), request);
}

std::unique_ptr<NativeContext> create_egl_surfaceless_context(Request request) {
    const std::string where = "surfaceless";
    if (!egl().has_client_extension("EGL_MESA_platform_surfaceless"))
        throw EnvironmentError(
            fmt::format("{}: EGL has no EGL_MESA_platform_surfaceless; install libegl-mesa0 (Debian)", where));
    return std::make_unique<EglContext>(where, Display::open(where, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY),
                                        request);
}

}  // namespace lightsweep::gl
