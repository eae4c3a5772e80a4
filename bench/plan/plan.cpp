#include "bench/plan/plan.h"

#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/base/names.h"

#include <fmt/format.h>

#include <charconv>
#include <regex>
#include <unordered_map>

namespace lightsweep {
namespace {

std::vector<CellParams> filter_cells(std::vector<CellParams> cells, const std::string& filter) {
    if (filter.empty()) return cells;
    std::regex expression;
    try {
        expression = std::regex(filter);
    } catch (const std::regex_error& error) {
        throw InputError("filter '" + filter + "'",
                         fmt::format("not a regular expression (ECMAScript): {}", error.what()));
    }
    const std::string example = cells.empty() ? std::string() : cells.front().name();
    const size_t count = cells.size();
    std::erase_if(cells, [&](const CellParams& cell) { return !std::regex_search(cell.name(), expression); });
    if (cells.empty()) {
        throw InputError("filter '" + filter + "'",
                         fmt::format("matches none of the {} cells; they have names like '{}'", count, example));
    }
    return cells;
}

std::vector<PlanGroup> group_cells(std::vector<CellParams> cells) {
    std::vector<PlanGroup> groups;
    std::unordered_map<std::string, size_t> index_of;
    for (auto& cell : cells) {
        const std::string key = cell.group();
        const auto [entry, is_new] = index_of.try_emplace(key, groups.size());
        if (is_new) groups.push_back({.key = key, .cells = {}});
        groups[entry->second].cells.push_back(std::move(cell));
    }
    return groups;
}

}  // namespace

Shard parse_shard(const std::string& text) {
    const auto number = [](const std::string& part) {
        int value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        return error == std::errc{} && end == part.data() + part.size() ? value : 0;
    };
    const auto parts = split(text, '/');
    const Shard shard{parts.size() == 2 ? number(parts[0]) : 0, parts.size() == 2 ? number(parts[1]) : 0};
    if (shard.index < 1 || shard.index > shard.count) {
        throw InputError("shard '" + text + "'",
                         "not a part of the plan; allowed: INDEX/COUNT with 1 <= INDEX <= COUNT");
    }
    return shard;
}

Plan make_plan(const Sweep& sweep, const AxisValues& overrides, const std::string& filter, Shard shard,
               const Catalog& catalog) {
    const auto groups = group_cells(filter_cells(sweep_cells(sweep, overrides, catalog), filter));
    Plan plan;
    plan.shard = shard;
    std::string names;
    for (size_t i = 0; i < groups.size(); ++i) {
        for (const auto& cell : groups[i].cells) names += cell.name() + "\n";
        plan.total_cell_count += groups[i].cells.size();
        if (i % static_cast<size_t>(shard.count) != static_cast<size_t>(shard.index - 1)) continue;
        plan.cell_count += groups[i].cells.size();
        plan.groups.push_back(groups[i]);
    }
    plan.hash = hash_hex(names);
    if (plan.groups.empty()) {
        throw InputError(fmt::format("shard {}/{}", shard.index, shard.count),
                         fmt::format("has no group: the plan has only {}; use fewer shards", groups.size()));
    }
    return plan;
}

}  // namespace lightsweep
