// Names for the planning tests that do not depend on what the program ships.
#pragma once

#include "bench/plan/axes.h"

#include "renderer/base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace lightsweep {

inline Catalog test_catalog() {
    return {.paths = {{"forward"},
                      {"forward_prepass"},
                      {"forward_clustered", false, true},
                      {"deferred", true},
                      {"deferred_volumes", true},
                      {"deferred_tiled", true, true}},
            .layouts = {"float32", "oct16", "oct32"},
            .scenes = {"atrium", "cornell", "materials"}};
}

/// The one line that a user sees when `action` meets bad input; fails the test when it does not.
template <typename Action>
std::string input_error(Action action) {
    try {
        action();
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    ADD_FAILURE() << "no InputError";
    return {};
}

}  // namespace lightsweep
