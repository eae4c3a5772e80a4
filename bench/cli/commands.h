// The program's commands: one file each. A command registers its options, and gives what runs it.
#pragma once

#include "bench/measure/exit_code.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace lightsweep {

using Command = std::function<int()>;

Command add_list(CLI::App& app);
Command add_doctor(CLI::App& app);
Command add_needs(CLI::App& app);
/// `arguments`: of the whole program, for the report.
Command add_run(CLI::App& app, const std::vector<std::string>& arguments);
Command add_explore(CLI::App& app, const std::vector<std::string>& arguments);
Command add_render(CLI::App& app);
Command add_diff(CLI::App& app);
Command add_encodings(CLI::App& app);
Command add_stress(CLI::App& app, const std::vector<std::string>& arguments);
Command add_compare(CLI::App& app);
Command add_merge(CLI::App& app);

}  // namespace lightsweep
