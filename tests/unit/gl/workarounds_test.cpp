#include "renderer/gl/workarounds.h"

#include "renderer/gl/context.h"

#include <gmock/gmock.h>

#include <set>

namespace lightsweep::gl {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

ContextInfo context(const std::string& provider, const std::string& renderer, const std::string& version) {
    ContextInfo info;
    info.provider = provider;
    info.renderer = renderer;
    info.version = version;
    return info;
}

TEST(Workarounds, EachHasAKeyOfItsOwnAndSaysWhetherTheProgramActsOnIt) {
    std::set<std::string> keys;
    for (const Workaround& workaround : all_workarounds()) {
        EXPECT_TRUE(keys.insert(workaround.key).second) << workaround.key;
        EXPECT_THAT(workaround.paragraph, AnyOf(HasSubstr("Acted on: "), HasSubstr("Only reported: ")));
    }
}

TEST(Workarounds, FollowTheDriverAndTheProvider) {
    const std::string version = "4.5 (Core Profile) Mesa 22.3.6";
    const auto egl = active_workarounds(context("egl_surfaceless", "llvmpipe (LLVM 15.0.6, 256 bits)", version));
    EXPECT_THAT(egl, Contains("llvmpipe_pow_zero"));
    EXPECT_THAT(egl, Contains("mesa_release_before_switch"));
    EXPECT_THAT(egl, Not(Contains("osmesa_no_debug_flag")));
    const auto osmesa = active_workarounds(context("osmesa", "llvmpipe (LLVM 15.0.6, 256 bits)", version));
    EXPECT_THAT(osmesa, Contains("osmesa_no_debug_flag"));
    EXPECT_THAT(active_workarounds(context("egl_device", "AMD Radeon RX 6600", version)),
                Not(Contains("llvmpipe_pow_zero")));
    EXPECT_THAT(active_workarounds(context("egl_device", "NVIDIA H200/PCIe/SSE2", "4.5.0 NVIDIA 535.161")), IsEmpty());
}

}  // namespace
}  // namespace lightsweep::gl
