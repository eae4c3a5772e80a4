// The outermost function of the project's programs: every failure that a user can cure is one line on stderr and an
// exit code.
#pragma once

#include "bench/measure/exit_code.h"

namespace lightsweep {

/// Runs `body` and turns what it throws into `program: message` and an exit code.
int checked_main(const char* program, int (*body)(int argc, char** argv), int argc, char** argv);

}  // namespace lightsweep
