// Contexts: where they come from, how they share a process, what they report, and how they are refused.
#include "renderer/gl/context.h"

#include "renderer/base/error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <glad/gl.h>

namespace lightsweep::gl {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

constexpr const char* kProbe = "LIGHTSWEEP_TEST_PROBE";

// Drivers are chosen once per process, so a machine without them needs a process of its own: this very program, which
// then prints what came of making the context and ends before main(), where a context might be made.
const bool probed = [] {
    const char* const device = std::getenv(kProbe);
    if (!device) return false;
    try {
        std::puts(("ok: " + Context::create(device)->info().renderer).c_str());
    } catch (const EnvironmentError& error) {
        std::puts((std::string("EnvironmentError: ") + error.what()).c_str());
    } catch (const InputError& error) {
        std::puts((std::string("InputError: ") + error.what()).c_str());
    }
    std::fflush(stdout);
    std::_Exit(0);
}();

// The lines that a process prints that has `variables` ("A=x B=y") set and makes a context on `device`.
std::vector<std::string> probe(const std::string& device, const std::string& variables) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = fmt::format("env {} {}={} '{}'", variables, kProbe, device, program);
    std::vector<std::string> lines;
    FILE* const output = popen(command.c_str(), "r");
    char line[4096];
    while (output && std::fgets(line, sizeof line, output)) lines.emplace_back(line);
    EXPECT_EQ(output ? pclose(output) : -1, 0) << command;
    return lines;
}

// A texture of one pixel, cleared to a grey level, and read through a framebuffer.
class Pixel {
  public:
    explicit Pixel(float grey) {
        glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
        glTextureStorage2D(texture_, 1, GL_R32F, 1, 1);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
        glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, &grey);
    }
    float read() const {
        float grey = -1.0f;
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
        glReadPixels(0, 0, 1, 1, GL_RED, GL_FLOAT, &grey);
        return grey;
    }

  private:
    GLuint texture_ = 0, framebuffer_ = 0;  // they go with their context
};

// Other tests in the program may share a context: it is current again after each test here.
class ContextTest : public testing::Test {
  protected:
    void TearDown() override {
        if (previous_) previous_->make_current();
    }

  private:
    Context* const previous_ = Context::current();
};

class EveryProvider : public ContextTest, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Context, EveryProvider, testing::Values("surfaceless", "osmesa"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(EveryProvider, GivesCore45AndSaysSo) {
    const auto context = Context::create(GetParam());
    EXPECT_EQ(Context::current(), context.get());
    const ContextInfo& info = context->info();
    EXPECT_EQ(info.device, GetParam());
    EXPECT_GE(info.major * 10 + info.minor, 45);
    EXPECT_THAT(info.version, StartsWith(fmt::format("{}.{}", info.major, info.minor)));
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_THAT(context->take_debug_errors(), IsEmpty());
}

// The minima are those of the OpenGL 4.5 core specification, tables 23.53 and following.
TEST_P(EveryProvider, LimitsAreAtLeastWhatCore45Promises) {
    const auto context = Context::create(GetParam());
    const Limits& limits = context->limits();
    EXPECT_GE(limits.max_texture_size_px, 16384);
    EXPECT_GE(limits.max_color_attachments, 8);
    EXPECT_GE(limits.max_samples, 4);
    EXPECT_GE(limits.max_uniform_block_bytes, 16384);
    EXPECT_GE(limits.max_storage_block_bytes, 1 << 24);
    EXPECT_GE(limits.max_compute_shared_bytes, 32768);
    EXPECT_GE(limits.subpixel_bits, 4);
    EXPECT_GE(limits.max_loop_rounds, 65535);  // no promise of GL: what llvmpipe grants
    std::set<std::string_view> names;
    for (const auto& [name, value] : named_limits(limits)) EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(names.size() * sizeof(int64_t), sizeof(Limits)) << "a limit without a name";
}

TEST_P(EveryProvider, RecordsGlErrorsOnceAndBounded) {
    const auto context = Context::create(GetParam());
    glEnable(0x1234);
    EXPECT_THAT(context->take_debug_errors(), SizeIs(1));
    EXPECT_THAT(context->take_debug_errors(), IsEmpty());
    EXPECT_NO_THROW(context->throw_on_debug_errors("nothing"));
    for (int i = 0; i < 1000; ++i) glEnable(0x1234);
    try {
        context->throw_on_debug_errors("the test");
        ADD_FAILURE() << "no exception";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("in the test: "));
    }
    EXPECT_THAT(context->take_debug_errors(), IsEmpty());
    while (glGetError() != GL_NO_ERROR) {
    }
}

TEST_P(EveryProvider, LeavesNotificationsAndMarkersOut) {
    const auto context = Context::create(GetParam());
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group");
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 0, GL_DEBUG_SEVERITY_HIGH, -1, "slow");
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 0, GL_DEBUG_SEVERITY_LOW, -1, "chat");
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 0, GL_DEBUG_SEVERITY_HIGH, -1, "alarm");
    glPopDebugGroup();
    EXPECT_THAT(context->take_debug_errors(), testing::ElementsAre("alarm"));
}

TEST_P(EveryProvider, AContextOutlivesAnotherOfItsDevice) {
    auto first = Context::create(GetParam());
    const Pixel pixel(0.25f);
    auto second = Context::create(GetParam());
    second.reset();
    EXPECT_EQ(Context::current(), nullptr);
    first->make_current();
    EXPECT_EQ(pixel.read(), 0.25f);
}

TEST_F(ContextTest, EglAndOSMesaCoexistInOneProcess) {
    const auto egl = Context::create("surfaceless");
    const Pixel egl_pixel(0.25f);
    const auto osmesa = Context::create("osmesa");
    const Pixel osmesa_pixel(0.75f);
    for (int turn = 0; turn < 3; ++turn) {
        egl->make_current();
        EXPECT_EQ(egl_pixel.read(), 0.25f);
        osmesa->make_current();
        EXPECT_EQ(osmesa_pixel.read(), 0.75f);
    }
    glEnable(0x1234);
    EXPECT_THAT(egl->take_debug_errors(), IsEmpty());
    EXPECT_THAT(osmesa->take_debug_errors(), SizeIs(1));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_ENUM));
}

TEST_F(ContextTest, AnUnknownDeviceIsBadInput) {
    for (const char* key : {"", "egl", "egl:", "egl:x", "egl:-1", "egl:1x", "EGL:0", "cuda:0"})
        EXPECT_THROW(Context::create(key), InputError) << key;
    try {
        Context::create("osmesaa");
        ADD_FAILURE() << "no exception";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("did you mean 'osmesa'?"), HasSubstr("surfaceless")));
    }
}

TEST_F(ContextTest, AFailedCreateLeavesTheCurrentContextCurrent) {
    const auto context = Context::create("osmesa");
    const Pixel pixel(0.5f);
    EXPECT_THROW(Context::create("egl:999"), EnvironmentError);
    EXPECT_EQ(Context::current(), context.get());
    EXPECT_EQ(pixel.read(), 0.5f);
}

TEST_F(ContextTest, RequireRendererMatchesThePatternOrRefuses) {
    const auto context = Context::create("osmesa");
    EXPECT_NO_THROW(require_renderer(*context, "^LLVM.*pipe"));
    EXPECT_THROW(require_renderer(*context, "NVIDIA|Radeon"), EnvironmentError);
    EXPECT_THROW(require_renderer(*context, "llvmpipe("), InputError);
}

TEST_F(ContextTest, ListsEveryDeviceOnceAndRestoresTheCurrentContext) {
    const auto context = Context::create("osmesa");
    const Pixel pixel(0.5f);
    const std::vector<DeviceInfo> devices = list_devices();
    EXPECT_EQ(Context::current(), context.get());
    EXPECT_EQ(pixel.read(), 0.5f);
    std::set<std::string> keys;
    for (const DeviceInfo& device : devices) {
        EXPECT_TRUE(keys.insert(device.key).second) << device.key;
        EXPECT_NE(device.available, device.renderer.empty()) << device.key;
        EXPECT_EQ(device.available, device.reason.empty()) << device.key;
    }
    EXPECT_THAT(devices, Contains(AllOf(Field(&DeviceInfo::key, "osmesa"), Field(&DeviceInfo::available, true),
                                        Field(&DeviceInfo::software, true),
                                        Field(&DeviceInfo::renderer, context->info().renderer))));
    EXPECT_TRUE(keys.contains("surfaceless"));
}

TEST_F(ContextTest, WithoutAnEglDriverTheEnvironmentIsRefusedInOneLine) {
    const std::filesystem::path empty = std::filesystem::path(testing::TempDir()) / "no_egl_vendors";
    std::filesystem::create_directories(empty);
    const std::string no_drivers = "__EGL_VENDOR_LIBRARY_DIRS=" + empty.string();
    for (const char* device : {"surfaceless", "egl:0"}) {
        const auto lines = probe(device, no_drivers);
        ASSERT_THAT(lines, SizeIs(1)) << device;
        EXPECT_THAT(lines[0], AllOf(StartsWith("EnvironmentError: "), HasSubstr("libegl-mesa0")));
    }
    // OSMesa has no need of EGL, and auto gets there.
    for (const char* device : {"osmesa", "auto"})
        EXPECT_THAT(probe(device, "-u LIGHTSWEEP_DEVICE " + no_drivers), testing::ElementsAre(StartsWith("ok: ")));
    std::filesystem::remove(empty);
}

TEST_F(ContextTest, ARendererBelow45IsRefusedByName) {
    for (const char* device : {"surfaceless", "osmesa"}) {
        const auto lines = probe(device, "GALLIUM_DRIVER=softpipe");
        ASSERT_THAT(lines, SizeIs(1)) << device;
        EXPECT_THAT(lines[0], AllOf(StartsWith("EnvironmentError: "), HasSubstr("softpipe"), HasSubstr("4.5")));
    }
}

TEST_F(ContextTest, TheEnvironmentChoosesForAutoOnly) {
    EXPECT_THAT(probe("auto", "LIGHTSWEEP_DEVICE=nonsense"),
                testing::ElementsAre(StartsWith("InputError: LIGHTSWEEP_DEVICE: ")));
    EXPECT_THAT(probe("osmesa", "LIGHTSWEEP_DEVICE=nonsense"), testing::ElementsAre(StartsWith("ok: ")));
}

}  // namespace
}  // namespace lightsweep::gl
