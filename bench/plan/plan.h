// What a run will do, decided before anything is measured: groups of cells in a fixed order, and a hash that says
// whether two runs, or two shards of one, have the same plan.
#pragma once

#include "bench/plan/sweep.h"

#include <string>
#include <vector>

namespace lightsweep {

/// Which part of the plan this process takes. The group is the unit, since only cells of one process are comparable.
struct Shard {
    int index = 1;  ///< [1, count]
    int count = 1;
};

/// `2/3`. Throws InputError.
Shard parse_shard(const std::string& text);

/// Cells that are measured together, interleaved, and compared with each other.
struct PlanGroup {
    std::string key;  ///< CellParams::group() of each of them
    std::vector<CellParams> cells;
};

struct Plan {
    std::vector<PlanGroup> groups;  ///< this shard's, in the order of first appearance in the sweep
    std::string hash;               ///< of every cell's name in the whole plan: the same in each shard
    size_t cell_count = 0;          ///< in this shard's groups
    size_t total_cell_count = 0;    ///< in all shards
    Shard shard;
};

/// `filter`: cells whose name does not contain a match of this regular expression (ECMAScript) are dropped; empty: none
/// is. Throws InputError for a bad expression, and for a plan without cells, saying what emptied it.
Plan make_plan(const Sweep& sweep, const AxisValues& overrides, const std::string& filter, Shard shard,
               const Catalog& catalog);

}  // namespace lightsweep
