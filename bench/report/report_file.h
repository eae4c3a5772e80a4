// A report read back: the part of report.json that other tools of the program build on. Unknown keys are ignored.
#pragma once

#include "bench/report/record.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace lightsweep {

struct Report {
    RunInfo run;
    Environment environment;
    std::optional<double> noise_floor;
    std::vector<CellResult> cells;
};

/// Throws InputError naming the place: not JSON, another format or version, a key missing or of the wrong type.
Report read_report(const std::filesystem::path& file);
/// The same of a parsed report; `where` stands for the file in messages.
Report parse_report(const Json& json, const std::string& where);

}  // namespace lightsweep
