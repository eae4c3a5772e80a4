#include "renderer/gl/context.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/gl/provider_internal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glad/gl.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <optional>
#include <regex>
#include <utility>

namespace lightsweep::gl {
namespace {

// --- Device keys ---

struct DeviceKey {
    const char* provider = "";
    std::string key;
    std::function<std::unique_ptr<NativeContext>(Request)> create;
    bool software = false;  // EGL says so; the renderer's name may say so later
};

DeviceKey egl_device(size_t index) {
    const std::vector<bool> flags = egl_device_software_flags();
    return {"egl_device", fmt::format("egl:{}", index),
            [index](Request request) { return create_egl_device_context(index, request); },
            index < flags.size() && flags[index]};
}

DeviceKey surfaceless() { return {"egl_surfaceless", "surfaceless", create_egl_surfaceless_context}; }
DeviceKey osmesa() { return {"osmesa", "osmesa", create_osmesa_context}; }

// `where` is what the message blames: the option or the environment variable.
DeviceKey parse_device(std::string_view key, const std::string& where) {
    if (key == "surfaceless") return surfaceless();
    if (key == "osmesa") return osmesa();
    if (key.starts_with("egl:")) {
        size_t index = 0;
        const char* const end = key.data() + key.size();
        const auto [rest, error] = std::from_chars(key.data() + 4, end, index);
        if (error == std::errc() && rest == end) return egl_device(index);
    }
    static const std::vector<std::string> kKeys = {"auto", "egl:N", "osmesa", "surfaceless"};
    throw InputError(where, unknown_name("device", key, kKeys));
}

// --- What a fresh context says of itself ---

constexpr size_t kMaxDebugErrors = 64;  // an error in every draw of a long run must not fill the memory

struct DebugLog {
    std::mutex mutex;  // when debug output is not synchronous, a driver may report from a thread of its own
    std::vector<std::string> errors;
};

void GLAD_API_PTR on_debug_message(GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar* message, const void* user) {
    DebugLog& log = *static_cast<DebugLog*>(const_cast<void*>(user));
    const std::lock_guard lock(log.mutex);
    if (log.errors.size() < kMaxDebugErrors) log.errors.emplace_back(message);
}

// The filter is the driver's, so that what nobody reads costs nothing. A shader that does not compile is left out: its
// log is read, and thrown with the original file and line, by the one who compiles it.
void record_errors(DebugLog& log) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_HIGH, 0, nullptr, GL_TRUE);
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_PERFORMANCE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    glDebugMessageCallback(on_debug_message, &log);
}

std::string gl_string(PFNGLGETSTRINGPROC get_string, GLenum name) {
    const GLubyte* const text = get_string ? get_string(name) : nullptr;
    return text ? reinterpret_cast<const char*>(text) : "";
}

ContextInfo describe(const DeviceKey& device) {
    ContextInfo info{.provider = device.provider,
                     .device = device.key,
                     .vendor = gl_string(glGetString, GL_VENDOR),
                     .renderer = gl_string(glGetString, GL_RENDERER),
                     .version = gl_string(glGetString, GL_VERSION),
                     .glsl_version = gl_string(glGetString, GL_SHADING_LANGUAGE_VERSION)};
    static const std::regex kSoftware("llvmpipe|softpipe|swrast|swiftshader|software rasterizer", std::regex::icase);
    info.software = device.software || std::regex_search(info.renderer, kSoftware);
    glGetIntegerv(GL_MAJOR_VERSION, &info.major);
    glGetIntegerv(GL_MINOR_VERSION, &info.minor);
    return info;
}

// What the device has instead of 4.5 core, and the cure; empty when it has nothing. Leaves no context current.
std::string offered_instead(const DeviceKey& device) {
    try {
        const auto native = device.create(Request::any);
        native->make_current();
        // Not through glad: its process-wide pointers belong to contexts of at least 4.5.
        const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(native->loader()("glGetString"));
        std::string offered = fmt::format("{} offers OpenGL {}; choose another device or driver ($GALLIUM_DRIVER)",
                                          gl_string(get_string, GL_RENDERER), gl_string(get_string, GL_VERSION));
        native->release();
        return offered;
    } catch (const EnvironmentError&) {
        return {};
    }
}

thread_local Context* current_context = nullptr;
GlLoader loaded_from = nullptr;  // where glad's function pointers point to

}  // namespace

// --- Context ---

struct Context::Impl {
    DebugLog debug;  // outlives `native`, whose threads may write to it
    std::unique_ptr<NativeContext> native;
    ContextInfo info;
    Limits limits;

    static void release_current() {
        if (current_context) current_context->impl_->native->release();
        current_context = nullptr;
    }

    // The new context is current afterwards; when it throws, the old one is again.
    static std::unique_ptr<Context> open(const DeviceKey& device) {
        Context* const previous = current_context;
        std::unique_ptr<Context> context;
        try {
            auto impl = std::make_unique<Impl>();
            impl->native = device.create(Request::core_4_5);
            context.reset(new Context(std::move(impl)));
            context->make_current();
        } catch (const EnvironmentError& error) {
            context.reset();
            release_current();
            const std::string offered = offered_instead(device);
            if (previous) previous->make_current();
            if (offered.empty()) throw;
            throw EnvironmentError(fmt::format("{}: {}", error.what(), offered));
        }
        record_errors(context->impl_->debug);
        context->impl_->info = describe(device);
        context->impl_->limits = query_limits();
        return context;
    }

    static std::unique_ptr<Context> open_best();
};

std::unique_ptr<Context> Context::Impl::open_best() {
    Context* const previous = current_context;
    std::vector<std::string> tried;
    const auto note = [&tried](const EnvironmentError& error) {
        // A missing library fails every key that needs it with the same words.
        if (std::find(tried.begin(), tried.end(), error.what()) == tried.end()) tried.emplace_back(error.what());
    };
    std::vector<DeviceKey> devices;
    try {
        const std::vector<bool> software = egl_device_software_flags();
        for (size_t i = 0; i < software.size(); ++i) devices.push_back(egl_device(i));
    } catch (const EnvironmentError& error) {
        note(error);
    }
    const auto attempt = [&note](const DeviceKey& device, bool accept_software) -> std::unique_ptr<Context> {
        try {
            auto context = open(device);
            if (accept_software || !context->info().software) return context;
        } catch (const EnvironmentError& error) {
            note(error);
        }
        return nullptr;
    };
    for (const DeviceKey& device : devices)
        if (!device.software)
            if (auto context = attempt(device, false)) return context;
    devices.insert(devices.begin(), surfaceless());
    devices.push_back(osmesa());
    for (const DeviceKey& device : devices)
        if (auto context = attempt(device, true)) return context;
    if (previous) previous->make_current();
    throw EnvironmentError(fmt::format("no OpenGL 4.5 core context; tried: {}", fmt::join(tried, " | ")));
}

std::unique_ptr<Context> Context::create(std::string_view device) {
    if (device != "auto") return Impl::open(parse_device(device, "--device"));
    const char* const wish = std::getenv("LIGHTSWEEP_DEVICE");
    if (wish && *wish && wish != device) return Impl::open(parse_device(wish, "LIGHTSWEEP_DEVICE"));
    return Impl::open_best();
}

Context::Context(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Context::~Context() {
    if (current_context == this) Impl::release_current();
}

Context* Context::current() { return current_context; }

void Context::make_current() {
    if (current_context == this) return;
    // EGL and OSMesa do not see each other's current context: each must let go before the other takes the thread.
    Impl::release_current();
    impl_->native->make_current();
    current_context = this;
    if (const GlLoader loader = impl_->native->loader(); loader != loaded_from) {
        loaded_from = loader;
        gladLoadGL(loader);
    }
}

const ContextInfo& Context::info() const { return impl_->info; }
const Limits& Context::limits() const { return impl_->limits; }

void Context::set_debug_synchronous(bool synchronous) {
    CHECK(current_context == this);
    (synchronous ? glEnable : glDisable)(GL_DEBUG_OUTPUT_SYNCHRONOUS);
}

std::vector<std::string> Context::take_debug_errors() {
    const std::lock_guard lock(impl_->debug.mutex);
    return std::exchange(impl_->debug.errors, {});
}

void Context::throw_on_debug_errors(std::string_view where) {
    const std::vector<std::string> errors = take_debug_errors();
    if (errors.empty()) return;
    const std::string more = errors.size() > 1 ? fmt::format(" (and {} more)", errors.size() - 1) : "";
    throw std::runtime_error(fmt::format("OpenGL error in {}: {}{}", where, errors.front(), more));
}

void require_renderer(const Context& context, const std::string& regex) {
    const std::string& renderer = context.info().renderer;
    try {
        if (std::regex_search(renderer, std::regex(regex, std::regex::ECMAScript | std::regex::icase))) return;
    } catch (const std::regex_error& error) {
        throw InputError("--require-renderer", fmt::format("'{}' is no regular expression: {}", regex, error.what()));
    }
    throw EnvironmentError(
        fmt::format("the renderer '{}' (device {}) does not match the required '{}'; `lightsweep list "
                    "devices` shows what there is",
                    renderer, context.info().device, regex));
}

std::vector<DeviceInfo> list_devices() {
    Context* const previous = current_context;
    std::vector<DeviceInfo> list;
    const auto probe = [&list](const std::string& key) {
        DeviceInfo device;
        device.key = key;
        try {
            const ContextInfo info = Context::create(key)->info();
            device = {key, true, "", info.renderer, info.version, info.software};
        } catch (const EnvironmentError& error) {
            device.reason = error.what();
        }
        list.push_back(std::move(device));
    };
    size_t egl_devices = 0;
    try {
        egl_devices = egl_device_software_flags().size();
    } catch (const EnvironmentError&) {
        // The probe of surfaceless, which needs EGL too, gives the reason.
    }
    for (size_t i = 0; i < egl_devices; ++i) probe(fmt::format("egl:{}", i));
    probe("surfaceless");
    probe("osmesa");
    if (previous) previous->make_current();
    return list;
}

}  // namespace lightsweep::gl
