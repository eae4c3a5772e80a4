// The options that every command with a GL context shares.
#pragma once

#include "renderer/gl/context.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace lightsweep {

struct DeviceOptions {
    std::string device = "auto";
    std::string renderer_regex;
    void add(CLI::App& command);
    /// Makes the context current and sets the defaults every path expects. Throws InputError, EnvironmentError.
    std::unique_ptr<gl::Context> make_context() const;
};

}  // namespace lightsweep
