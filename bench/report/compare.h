// Two reports against each other, cell by cell: what became faster or slower. Pure functions of their samples.
#pragma once

#include "bench/report/report_file.h"

#include "bench/stats/ratio.h"

#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// A cell that is ok in both reports.
struct ComparedCell {
    std::string id;
    std::string name;
    double base_ns = 0.0;  ///< median of wall_ns
    double new_ns = 0.0;
    /// new over base. The frames of two runs have no pairs, so the interval is that of two medians, each at the level
    /// that makes the ratio's at least 95 %. It does not hold what changed between the runs: see `floor`.
    Interval ratio;
    Verdict verdict = Verdict::ambiguous;  ///< of new against base
    bool over_limit = false;               ///< slower than the limit with the whole interval
};

struct Comparison {
    std::vector<ComparedCell> cells;     ///< in the order of the new report
    std::vector<std::string> broken;     ///< names of cells that were ok and are not, with the reason
    std::vector<std::string> only_base;  ///< names of cells that the new report lacks
    std::vector<std::string> only_new;
    std::vector<std::string> warnings;  ///< why the two may not be comparable
    double floor = 0.0;                 ///< the larger noise floor of the two
    bool failed = false;                ///< with a limit: a cell is over it, or broken
};

/// `fail_on_percent`: the limit; 5 allows every cell to take 1.05 times as long. Nothing: no limit.
Comparison compare_reports(const Report& base, const Report& next, std::optional<double> fail_on_percent);

/// A table with one line per cell, then what could not be compared.
std::string comparison_text(const Comparison& comparison);
Json to_json(const Comparison& comparison);

}  // namespace lightsweep
