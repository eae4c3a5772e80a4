// The two kinds of failure that a user can cure. Each becomes one line on stderr and an exit code (bench/cli).
#pragma once

#include <stdexcept>
#include <string>

namespace lightsweep {

/// Bad usage or bad input: a file, a key, a value, a name. Exit code 2.
/// The message is one line: `where: what is wrong; what is allowed`.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
    InputError(const std::string& where, const std::string& what) : std::runtime_error(where + ": " + what) {}
};

/// The environment was refused: no context, wrong renderer, a device limit, no trustworthy timer. Exit code 3.
struct EnvironmentError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace lightsweep
