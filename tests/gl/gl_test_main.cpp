// Runs the GL tests on one context: $LIGHTSWEEP_TEST_DEVICE, or auto. References are cached in a folder of this
// process's own: what another run left must not hide a fault.
#include "tests/gl/fixture.h"

#include "renderer/gl/context.h"
#include "renderer/gl/state.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
    const auto cache = std::filesystem::temp_directory_path() / fmt::format("lightsweep-cache-{}", getpid());
    setenv("LIGHTSWEEP_CACHE", cache.c_str(), 1);
    const char* device = std::getenv("LIGHTSWEEP_TEST_DEVICE");
    try {
        const auto context = lightsweep::gl::Context::create(device != nullptr ? device : "auto");
        lightsweep::gl::set_context_defaults();
        std::printf("on %s (%s)\n", context->info().renderer.c_str(), context->info().device.c_str());
        const int result = RUN_ALL_TESTS();
        std::error_code ignored;  // it may never have been made
        std::filesystem::remove_all(cache, ignored);
        return result;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "no GL for the tests: %s\n", error.what());
        return 3;
    }
}
