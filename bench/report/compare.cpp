#include "bench/report/compare.h"

#include "bench/report/json_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace lightsweep {
namespace {

constexpr double kLevel = 0.95;

Interval wall_median(const CellResult& cell) {
    const std::vector<double> wall_ns(cell.samples.wall_ns.begin(), cell.samples.wall_ns.end());
    return median_interval(wall_ns, level_for_each(kLevel, 2));
}

// new over base. An end is open where either median's is.
Interval ratio_of_medians(const Interval& next, const Interval& base) {
    Interval ratio{.estimate = next.estimate / base.estimate, .low = {}, .high = {}};
    if (next.low && base.high) ratio.low = *next.low / *base.high;
    if (next.high && base.low && *base.low > 0.0) ratio.high = *next.high / *base.low;
    return ratio;
}

bool has_times(const CellResult& cell) {
    return cell.measured() && std::ranges::all_of(cell.samples.wall_ns, [](int64_t ns) { return ns > 0; });
}

std::string why_not(const CellResult& cell) {
    return fmt::format("{} ({}: {})", cell.name, kCellStatusNames[static_cast<size_t>(cell.status)],
                       cell.reason.value_or("no samples"));
}

std::vector<std::string> differences(const Report& base, const Report& next) {
    std::vector<std::string> warnings;
    if (base.environment.fingerprint != next.environment.fingerprint) {
        warnings.push_back("the environments differ, so the times may differ for reasons other than the program: " +
                           environment_difference(base.environment, next.environment));
    }
    if (base.run.build_type != next.run.build_type) {
        warnings.push_back(fmt::format("the build types differ: {} / {}", base.run.build_type, next.run.build_type));
    }
    if (!base.noise_floor || !next.noise_floor) {
        warnings.push_back("a report measured no noise floor: a difference may be noise");
    }
    return warnings;
}

std::string end_text(const std::optional<double>& end) { return end ? fmt::format("{:.3f}", *end) : "?"; }

}  // namespace

Comparison compare_reports(const Report& base, const Report& next, std::optional<double> fail_on_percent) {
    Comparison result;
    result.warnings = differences(base, next);
    result.floor = std::max(base.noise_floor.value_or(0.0), next.noise_floor.value_or(0.0));
    std::map<std::string, const CellResult*> base_cells;
    for (const auto& cell : base.cells) base_cells[cell.id] = &cell;
    for (const auto& cell : next.cells) {
        const auto found = base_cells.find(cell.id);
        if (found == base_cells.end()) {
            result.only_new.push_back(cell.name);
            continue;
        }
        const CellResult& before = *found->second;
        if (before.auto_path && cell.auto_path && before.auto_path->path != cell.auto_path->path) {
            result.warnings.push_back(fmt::format("{}: came to {} in the base and to {} now", cell.name,
                                                  before.auto_path->path, cell.auto_path->path));
        }
        if (before.auto_skip && cell.auto_skip && before.auto_skip->skip != cell.auto_skip->skip) {
            result.warnings.push_back(fmt::format("{}: came to skip={} in the base and to {} now", cell.name,
                                                  before.auto_skip->skip, cell.auto_skip->skip));
        }
        base_cells.erase(found);
        if (!has_times(before)) continue;
        if (!has_times(cell)) {
            result.broken.push_back(why_not(cell));
            continue;
        }
        const Interval base_median = wall_median(before);
        const Interval new_median = wall_median(cell);
        ComparedCell row{.id = cell.id,
                         .name = cell.name,
                         .base_ns = base_median.estimate,
                         .new_ns = new_median.estimate,
                         .ratio = ratio_of_medians(new_median, base_median)};
        row.verdict = verdict(row.ratio, result.floor);
        row.over_limit = fail_on_percent && row.ratio.low && *row.ratio.low > 1.0 + *fail_on_percent / 100.0;
        result.failed |= row.over_limit;
        result.cells.push_back(std::move(row));
    }
    for (const auto& cell : base.cells) {
        if (base_cells.contains(cell.id)) result.only_base.push_back(cell.name);
    }
    result.failed |= fail_on_percent && !result.broken.empty();
    return result;
}

std::string comparison_text(const Comparison& comparison) {
    std::string text;
    for (const auto& warning : comparison.warnings) text += fmt::format("warning: {}\n", warning);
    size_t width = 4;
    for (const auto& cell : comparison.cells) width = std::max(width, cell.name.size());
    text += fmt::format("{:<{}}  {:>10}  {:>10}  {:>7}  {:<16}  verdict\n", "cell", width, "base ms", "new ms",
                        "new/base", "95 % interval");
    for (const auto& cell : comparison.cells) {
        text += fmt::format("{:<{}}  {:>10.3f}  {:>10.3f}  {:>8.3f}  {:<16}  {}{}\n", cell.name, width,
                            cell.base_ns * 1e-6, cell.new_ns * 1e-6, cell.ratio.estimate,
                            fmt::format("{} .. {}", end_text(cell.ratio.low), end_text(cell.ratio.high)),
                            word(cell.verdict), cell.over_limit ? ", over the limit" : "");
    }
    for (const auto& name : comparison.broken) text += fmt::format("was ok, is not: {}\n", name);
    for (const auto& name : comparison.only_base) text += fmt::format("only in base: {}\n", name);
    for (const auto& name : comparison.only_new) text += fmt::format("only in new: {}\n", name);
    return text;
}

Json to_json(const Comparison& comparison) {
    Json cells = Json::array();
    for (const auto& cell : comparison.cells) {
        cells.push_back({{"id", cell.id},
                         {"name", cell.name},
                         {"base_ns", codec::encode(cell.base_ns)},
                         {"new_ns", codec::encode(cell.new_ns)},
                         {"ratio", codec::encode(cell.ratio.estimate)},
                         {"low", codec::encode(cell.ratio.low)},
                         {"high", codec::encode(cell.ratio.high)},
                         {"verdict", word(cell.verdict)},
                         {"over_limit", cell.over_limit}});
    }
    return {{"cells", std::move(cells)},         {"broken", comparison.broken},
            {"only_base", comparison.only_base}, {"only_new", comparison.only_new},
            {"warnings", comparison.warnings},   {"floor", codec::encode(comparison.floor)},
            {"failed", comparison.failed}};
}

}  // namespace lightsweep
