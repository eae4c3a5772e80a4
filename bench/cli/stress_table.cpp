#include "bench/cli/stress_table.h"

#include "bench/cli/table.h"
#include "bench/stress/arm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace lightsweep {
namespace {

using Entries = std::vector<const Json*>;

std::string text_of(const Json& entry, const char* key) { return entry.at(key).get<std::string>(); }

// `250`, `3.2e4`: a breakdown is known to 5 %.
std::string short_number(double value) {
    if (value == std::round(value) && std::abs(value) < 1e4) return fmt::format("{:.0f}", value);
    std::string text = fmt::format("{:.3g}", value);
    for (const auto& [from, to] : {std::pair{"e+0", "e"}, std::pair{"e+", "e"}, std::pair{"e-0", "e-"}}) {
        if (const size_t at = text.find(from); at != std::string::npos) text.replace(at, std::string(from).size(), to);
    }
    return text;
}

// `pass`, `limit 3.2e4`, `FAIL 12`: the number is the breakdown, or the first value that fails.
std::string verdict_text(const Json& entry) {
    const std::string status = text_of(entry, "status");
    if (status == "skipped") return "-";
    const std::string word = status == "fail" ? "FAIL" : status;
    const Json& at = entry.at(status == "fail" ? "at" : "breakdown");
    return at.is_null() ? word : word + " " + short_number(at.get<double>());
}

// The choices that all arms of a table share, where they have that axis at all: said once, in its title. The rows of
// `paths` are named by path in any case.
std::map<std::string, std::string> shared_choices(const Entries& entries, const std::string& table) {
    std::map<std::string, std::set<std::string>> values;
    std::set<std::string> arms;
    for (const Json* entry : entries) {
        arms.insert(text_of(*entry, "arm"));
        for (const auto& [axis, value] : entry->at("axes").items()) values[axis].insert(value.get<std::string>());
    }
    std::map<std::string, std::string> shared;
    for (const auto& [axis, found] : values) {
        if (arms.size() > 1 && found.size() == 1 && (axis != "path" || table != "paths")) shared[axis] = *found.begin();
    }
    return shared;
}

// `deferred oct16`, `deferred oct16 sums=compensated`: without what the title says.
std::string row_name(const Json& entry, const std::map<std::string, std::string>& shared) {
    std::string name;
    for (const auto& [axis, value] : entry.at("axes").items()) {
        if (shared.contains(axis)) continue;
        const bool bare = axis == "path" || axis == "layout" || axis == "hdr";
        name += (name.empty() ? "" : " ") + (bare ? "" : axis + "=") + value.get<std::string>();
    }
    return name.empty() ? text_of(entry, "arm") : name;
}

// `: hdr=rgba32f layout=float32`
std::string title_words(const std::map<std::string, std::string>& shared) {
    std::string words;
    for (const auto& [axis, value] : shared) words += fmt::format("{}{}={}", words.empty() ? ": " : " ", axis, value);
    return words;
}

using Cells = std::map<std::pair<std::string, std::string>, std::string>;  // (row, column)

std::string grid_text(const std::string& corner, const std::vector<std::string>& rows,
                      const std::vector<std::string>& columns, Cells& cells) {
    std::vector<std::string> header{corner};
    header.insert(header.end(), columns.begin(), columns.end());
    Table table(std::move(header));
    for (const auto& row : rows) {
        std::vector<std::string> line{row};
        for (const auto& column : columns) line.push_back(cells[{row, column}]);
        table.add(std::move(line));
    }
    return table.text();
}

// Rows are arms, columns are cases.
std::string arms_by_cases(const Entries& entries, const std::string& title) {
    if (entries.empty()) return "";
    const auto shared = shared_choices(entries, title);
    std::vector<std::string> ids, names;
    Cells cells;
    for (const Json* entry : entries) {
        const std::string id = text_of(*entry, "id");
        std::string name = row_name(*entry, shared);
        if (cells.contains({name, id})) name = text_of(*entry, "arm");
        if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        cells[{name, id}] = verdict_text(*entry);
    }
    return title + title_words(shared) + "\n" + grid_text("arm", names, ids, cells) + "\n";
}

// Of arms with one case's own axes: the values of the last one that varies side by side, the rest as rows.
std::string one_case(const Entries& entries, const std::string& columns_axis) {
    std::vector<std::string> rows, columns;
    Cells cells;
    auto unsaid = shared_choices(entries, "others");
    const std::string shared_words = title_words(unsaid);
    unsaid.emplace(columns_axis, "");
    for (const Json* entry : entries) {
        const std::string row = row_name(*entry, unsaid);
        const std::string column = entry->at("axes").value(columns_axis, "none");
        if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
        if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
        cells[{row, column}] = verdict_text(*entry);
    }
    const std::string id = text_of(*entries.front(), "id");
    return fmt::format("{} by {}{}\n{}\n", id, columns_axis, shared_words, grid_text(id, rows, columns, cells));
}

// The axis that arms are laid out by, where two vary: the last one that is the case's own; there are many paths and
// layouts, and they are rows.
std::string columns_axis_of(const Entries& entries) {
    const auto shared = shared_choices(entries, "others");
    std::vector<std::string> varying;
    for (const Json* entry : entries) {
        for (const auto& [axis, value] : entry->at("axes").items()) {
            const bool known = shared.contains(axis) || std::ranges::find(varying, axis) != varying.end();
            if (!known)
                varying.insert(axis == kPathAxis || axis == kLayoutAxis ? varying.begin() : varying.end(), axis);
        }
    }
    return entries.size() < 2 || varying.size() < 2 ? "" : varying.back();
}

// Its case and its axes; some paths take a layout and some lists, and are compared all the same.
std::string kind_of(const Json& entry) {
    std::string kind = text_of(entry, "id");
    for (const auto& [axis, value] : entry.at("axes").items()) {
        if (axis != kLayoutAxis && axis != "light_lists") kind += " " + axis;
    }
    return kind;
}

// Cases whose arms are not those of other cases: a table where two axes vary, a row for each arm of the rest.
std::string other_arms(const Entries& entries) {
    std::vector<std::pair<std::string, Entries>> kinds;
    for (const Json* entry : entries) {
        const std::string kind = kind_of(*entry);
        auto found = std::ranges::find(kinds, kind, &std::pair<std::string, Entries>::first);
        if (found == kinds.end()) found = kinds.insert(kinds.end(), {kind, {}});
        found->second.push_back(entry);
    }
    Table rest({"case", "arm", "result"});
    std::string tables;
    for (const auto& [kind, arms] : kinds) {
        if (const std::string axis = columns_axis_of(arms); !axis.empty()) {
            tables += one_case(arms, axis);
            continue;
        }
        for (const Json* entry : arms) {
            rest.add({text_of(*entry, "id"), text_of(*entry, "arm"), verdict_text(*entry)});
        }
    }
    return (rest.size() == 0 ? "" : "others\n" + rest.text() + "\n") + tables;
}

std::string named(const Json& entry) {
    const std::string arm = text_of(entry, "arm");
    return text_of(entry, "id") + (arm.empty() ? "" : " " + arm);
}

std::string failures_text(const Json& cases) {
    std::string text;
    for (const Json& entry : cases) {
        if (entry.at("status") == "fail") text += fmt::format("  {}: {}\n", named(entry), text_of(entry, "reason"));
    }
    return text.empty() ? "" : "failed\n" + text + "\n";
}

// The first to break of a case's arms: that which gets the least far from the easy end.
const Json* first_to_break(const Entries& limits) {
    const auto steps = [](const Json* entry) {
        const Json& parameter = entry->at("parameter");
        if (parameter.is_null() || entry->at("breakdown").is_null()) return 0.0;
        return std::abs(std::log(entry->at("breakdown").get<double>() / parameter.at("easy").get<double>()));
    };
    return *std::ranges::min_element(limits, {}, steps);
}

// A line for each case: how many arms, from where to where they break, and the first of them with its reason.
std::string limits_text(const Json& cases) {
    std::map<std::string, Entries> by_case;
    std::vector<std::string> ids;
    for (const Json& entry : cases) {
        if (entry.at("status") != "limit") continue;
        Entries& entries = by_case[text_of(entry, "id")];
        if (entries.empty()) ids.push_back(text_of(entry, "id"));
        entries.push_back(&entry);
    }
    std::string text;
    for (const auto& id : ids) {
        const Entries& limits = by_case[id];
        const Json& first = *first_to_break(limits);
        std::string range;
        if (!first.at("breakdown").is_null()) {
            std::vector<double> breakdowns;
            for (const Json* entry : limits) breakdowns.push_back(entry->at("breakdown").get<double>());
            const auto [low, high] = std::ranges::minmax(breakdowns);
            const Json& parameter = first.at("parameter");
            range = fmt::format(", {} {}{}{}{}", text_of(parameter, "name"), short_number(low),
                                low == high ? "" : " to " + short_number(high),
                                text_of(parameter, "unit").empty() ? "" : " ", text_of(parameter, "unit"));
        }
        const std::string arm = text_of(first, "arm");
        text += fmt::format("  {}: {} arm{}{}; {}{}{}\n", id, limits.size(), limits.size() == 1 ? "" : "s", range, arm,
                            arm.empty() ? "" : ": ", text_of(first, "reason"));
    }
    return text.empty() ? ""
                        : "limits (what a format cannot hold; of each case the arm that breaks first)\n" + text + "\n";
}

std::string skipped_text(const Json& cases) {
    std::vector<std::pair<std::string, int>> lines;
    for (const Json& entry : cases) {
        if (entry.at("status") != "skipped") continue;
        const std::string line = fmt::format("{}: {}", text_of(entry, "id"), text_of(entry, "reason"));
        const auto found = std::ranges::find(lines, line, &std::pair<std::string, int>::first);
        if (found == lines.end()) {
            lines.emplace_back(line, 1);
        } else {
            ++found->second;
        }
    }
    std::string text;
    for (const auto& [line, count] : lines)
        text += fmt::format("  {}{}\n", line, count > 1 ? fmt::format(" ({} arms)", count) : "");
    return text.empty() ? "" : "skipped\n" + text + "\n";
}

// The JSON has all of it.
std::string input_text(const Json& input) {
    constexpr size_t kMostLetters = 48;
    if (input.is_null()) return "";
    const auto text = input.get<std::string>();
    return text.size() <= kMostLetters ? text : text.substr(0, kMostLetters - 3) + "...";
}

std::string summary_text_of(const Json& summary) {
    const auto count = [&](const char* key) { return summary.at(key).get<int64_t>(); };
    return fmt::format("{} cases, {} arms: {} pass, {} limit, {} fail, {} skipped\n", count("cases"), count("arms"),
                       count("pass"), count("limit"), count("fail"), count("skipped"));
}

}  // namespace

std::string ulp_text(const Json& rows) {
    Table table({"function", "max ulp", "mean ulp", "largest at", "not finite", "first at", "inputs", "of"});
    for (const Json& row : rows) {
        const auto ulps = [&](const char* key) {
            return row.at(key).is_null() ? std::string("-") : short_number(row.at(key).get<double>());
        };
        table.add({text_of(row, "function"), ulps("max_ulp"), ulps("mean_ulp"), input_text(row.at("worst_input")),
                   row.at("non_finite").dump(), input_text(row.at("non_finite_input")), row.at("inputs").dump(),
                   text_of(row, "domain")});
    }
    return table.text();
}

std::string stress_text(const Json& report) {
    const Json& cases = report.at("cases");
    std::map<std::string, Entries> tables;
    for (const Json& entry : cases) tables[text_of(entry, "table")].push_back(&entry);
    std::string text = arms_by_cases(tables["paths"], "paths") + arms_by_cases(tables["layouts"], "layouts") +
                       other_arms(tables["others"]);
    if (report.contains("ulp")) text += ulp_text(report.at("ulp")) + "\n";
    return text + failures_text(cases) + limits_text(cases) + skipped_text(cases) +
           summary_text_of(report.at("summary"));
}

}  // namespace lightsweep
