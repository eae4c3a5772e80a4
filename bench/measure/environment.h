// What the report says about the machine: whatever changes times.
#pragma once

#include "bench/report/record.h"
#include "renderer/gl/context.h"

#include <string>

namespace lightsweep {

Environment read_environment(const gl::Context& context);

/// Of this program, as built.
std::string program_version();
std::optional<std::string> program_git_commit();
std::string program_build_type();

/// Now, as ISO 8601 in UTC.
std::string utc_now();

}  // namespace lightsweep
