// Runs the GL tests on one context: $LIGHTSWEEP_TEST_DEVICE, or auto.
#include "tests/gl/fixture.h"

#include "renderer/gl/context.h"
#include "renderer/gl/state.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
    const char* device = std::getenv("LIGHTSWEEP_TEST_DEVICE");
    try {
        const auto context = lightsweep::gl::Context::create(device != nullptr ? device : "auto");
        lightsweep::gl::set_context_defaults();
        std::printf("on %s (%s)\n", context->info().renderer.c_str(), context->info().device.c_str());
        return RUN_ALL_TESTS();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "no GL for the tests: %s\n", error.what());
        return 3;
    }
}
