// A stress run as a record, and as JSON (results/stress.schema.json). Holds no time: two runs of one program on one
// machine write the same.
#pragma once

#include "bench/measure/rounding_probe.h"
#include "bench/report/record.h"
#include "bench/stress/judge.h"
#include "bench/stress/ulp.h"

#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

inline constexpr const char* kStressSchema = "lightsweep-stress-1";

struct StressRun {
    std::vector<std::string> arguments;  ///< the command line, without the program's name
    std::string version;
    std::optional<std::string> git_commit;
    bool quick = false;
    Environment environment;
    std::vector<RoundingProbe> rounding;
    std::vector<StressResult> results;  ///< case by case
    std::optional<std::vector<UlpRow>> ulp;
};

/// The breakdown table that an arm is a row of, by what its case varies: `paths`, `layouts`, or `others` for what has
/// axes of the case's own. `results`: all of the case.
std::string table_of(const StressArm& arm, const std::vector<StressResult>& results);

/// Numbers that are not finite are null; what has one has a reason.
Json stress_json(const StressRun& run);
Json ulp_json(const std::vector<UlpRow>& rows);

}  // namespace lightsweep
