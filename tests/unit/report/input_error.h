// What a user sees when input is bad.
#pragma once

#include "renderer/base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace lightsweep {

/// The one line that `action` fails with; fails the test when there is none.
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
