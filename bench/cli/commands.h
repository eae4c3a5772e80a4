// The program's commands: one file each. A command registers its options, and gives what runs it.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace lightsweep {

/// What the shell sees: 0 done, 1 a verdict failed, 2 bad usage or input, 3 environment refused, 4 some cells
/// failed, 5 interrupted (run again with --resume).
enum ExitCode : int { kDone = 0, kVerdictFailed = 1, kBadInput = 2, kRefused = 3, kCellsFailed = 4, kInterrupted = 5 };

using Command = std::function<int()>;

Command add_list(CLI::App& app);
Command add_doctor(CLI::App& app);
/// `arguments`: of the whole program, for the report.
Command add_run(CLI::App& app, const std::vector<std::string>& arguments);
Command add_render(CLI::App& app);
Command add_diff(CLI::App& app);
Command add_compare(CLI::App& app);
Command add_merge(CLI::App& app);

}  // namespace lightsweep
