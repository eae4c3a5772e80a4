// OSMesa: Mesa's software rasteriser without any window system, through the C API that its GL/osmesa.h documents.
// The prototypes are written out here, so that its development package is not needed to build.
#include "renderer/base/error.h"
#include "renderer/gl/library.h"
#include "renderer/gl/provider_internal.h"

#include <array>

namespace lightsweep::gl {
namespace {

struct OSMesaContextHandle;  // opaque

constexpr int kFormat = 0x22, kRgba = 0x1908;
constexpr int kDepthBits = 0x30, kStencilBits = 0x31;
constexpr int kProfile = 0x33, kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36, kMinorVersion = 0x37;
constexpr unsigned kUnsignedByte = 0x1401;

struct OSMesa {
    Library library{"libOSMesa.so.8", "install libosmesa6 (Debian)"};
    OSMesaContextHandle* (*create)(const int* attributes, OSMesaContextHandle* share) =
        library.function<decltype(create)>("OSMesaCreateContextAttribs");
    void (*destroy)(OSMesaContextHandle*) = library.function<decltype(destroy)>("OSMesaDestroyContext");
    unsigned char (*make_current)(OSMesaContextHandle*, void* buffer, unsigned type, int width,
                                  int height) = library.function<decltype(make_current)>("OSMesaMakeCurrent");
    GlLoader get_proc_address = library.function<GlLoader>("OSMesaGetProcAddress");
};

const OSMesa& osmesa() {
    // Never unloaded: the rasteriser's threads and thread-local destructors live in it until the process ends.
    static const OSMesa* const library = new OSMesa;
    return *library;
}

class OSMesaContext : public NativeContext {
  public:
    explicit OSMesaContext(Request request) {
        // The default framebuffer is never drawn to, so it needs no depth or stencil.
        static constexpr int kAny[] = {kFormat, kRgba, kDepthBits, 0, kStencilBits, 0, 0};
        static constexpr int kCore[] = {kFormat,  kRgba,        kDepthBits,    0, kStencilBits,  0,
                                        kProfile, kCoreProfile, kMajorVersion, 4, kMinorVersion, 5,
                                        0};
        context_ = osmesa().create(request == Request::core_4_5 ? kCore : kAny, nullptr);
        if (!context_) throw EnvironmentError("osmesa: libOSMesa.so.8 gives no OpenGL 4.5 core context");
    }
    ~OSMesaContext() override { osmesa().destroy(context_); }
    OSMesaContext(const OSMesaContext&) = delete;
    OSMesaContext& operator=(const OSMesaContext&) = delete;

    void make_current() override {
        if (!osmesa().make_current(context_, pixel_.data(), kUnsignedByte, 1, 1))
            throw EnvironmentError("osmesa: OSMesaMakeCurrent failed");
    }
    void release() override { osmesa().make_current(nullptr, nullptr, 0, 0, 0); }
    GlLoader loader() const override { return osmesa().get_proc_address; }

  private:
    OSMesaContextHandle* context_ = nullptr;
    std::array<unsigned char, 4> pixel_{};  // OSMesa insists on memory for a default framebuffer
};

}  // namespace

std::unique_ptr<NativeContext> create_osmesa_context(Request request) {
    return std::make_unique<OSMesaContext>(request);
}

}  // namespace lightsweep::gl
