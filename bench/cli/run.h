// lightsweep run, for commands that end in a run of their own.
#pragma once

#include "bench/cli/device_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lightsweep {

/// As on the command line; an empty string is an option that was not given.
struct RunOptions {
    DeviceOptions device;
    std::string sweep = "default";
    std::vector<std::string> axes;
    std::string out, time_budget, target_ci, max_frame, filter, shard = "1/1", timer, max_error, max_time;
    int64_t seed = 0;
    bool maps = false, resume = false, dry_run = false, allow_debug = false;
};

/// Throws InputError where run_sweep() would for what these options say, apart from the sweep itself.
void check_run_options(const RunOptions& options);

/// Measures the sweep and returns the program's exit code. `arguments`: of the whole program, for the report.
int run_sweep(const RunOptions& options, const std::vector<std::string>& arguments);

}  // namespace lightsweep
