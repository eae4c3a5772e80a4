#include "bench/cli/summary.h"

#include "bench/cli/skip_table.h"
#include "bench/cli/table.h"
#include "bench/report/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace lightsweep {
namespace {

// In the unit of the median, which stands beside: `4.18 - 4.25`.
std::string interval_text(const Json& statistics) {
    if (statistics.at("low").is_null() && statistics.at("high").is_null()) return "-";
    const TimeUnit unit = time_unit(statistics.at("median").get<double>());
    const auto end = [&](const char* key) {
        return statistics.at(key).is_null() ? std::string("?") : time_number(statistics.at(key).get<double>(), unit);
    };
    return fmt::format("{} - {}", end("low"), end("high"));
}

std::string number_text(const Json& value, const char* format) {
    return value.is_null() ? "-" : fmt::format(fmt::runtime(format), value.get<double>());
}

std::string arm_text(const Json& arm) {
    std::string text = arm.at("path").get<std::string>();
    if (!arm.at("layout").is_null()) text += "/" + arm.at("layout").get<std::string>();
    if (!arm.at("light_lists").is_null()) text += "/" + arm.at("light_lists").get<std::string>();
    text += "/" + arm.at("hdr").get<std::string>();
    if (arm.at("skip") != kSkipEverything) text += "/" + arm.at("skip").get<std::string>();
    if (arm.at("guards") != kGuards.front()) text += "/guards=" + arm.at("guards").get<std::string>();
    if (arm.at("sums") != kSums.front()) text += "/sums=" + arm.at("sums").get<std::string>();
    return text;
}

// `cpu (auto)`: what was asked, where it is not what was used.
std::string lists_text(const Json& choice) {
    if (choice.is_null()) return "";
    const auto asked = choice.at("asked").get<std::string>(), used = choice.at("used").get<std::string>();
    return asked == used ? used : fmt::format("{} ({})", used, asked);
}

std::string size_text(const Json& params) {
    return fmt::format("{}x{}", params.at("width_px").get<int>(), params.at("height_px").get<int>());
}

std::string overlap_text(const Json& view) {
    return view.at("overlap").is_null() ? "fixed" : view.at("overlap").dump();
}

int64_t lost_px(const Json& cell) {
    const Json& error = cell.at("error");
    return error.is_null() ? 0 : error.at("lost_px").get<int64_t>();
}

// Flip, RMSE, normal, packing: what the note below the table says.
std::vector<std::string> error_columns(const Json& error) {
    if (error.is_null() || error.at("reference").is_null()) return {"-", "-", "-", "-"};
    const Json& display = error.at("reference").at("display");
    const Json& fields = error.at("fields");
    const Json& share = error.at("packing_share");
    return {number_text(display.at("flip_mean"), "{:.1e}"), number_text(display.at("rmse"), "{:.1e}"),
            fields.contains("normal") ? number_text(fields.at("normal").at("mean_deg"), "{:.2g}") : "-",
            share.is_null() ? "-" : fmt::format("{:.0f} %", 100.0 * share.get<double>())};
}

std::string path_text(const Json& cell) {
    if (cell.at("auto_path").is_null()) return cell.at("params").at("path").get<std::string>();
    return cell.at("auto_path").at("path").get<std::string>() + " (auto)";
}

std::string skip_text(const Json& cell) {
    if (cell.at("auto_skip").is_null()) return cell.at("params").at("skip").get<std::string>();
    return cell.at("auto_skip").at("skip").get<std::string>() + " (auto)";
}

// What all cells share is said once, above the table, which then fits a terminal.
std::string cell_table(const Json& report) {
    const std::vector<std::string> names{"scene", "lights", "size", "path",   "layout",
                                         "lists", "hdr",    "skip", "guards", "sums"};
    const bool any_lost = std::ranges::any_of(report.at("cells"), [](const Json& cell) { return lost_px(cell) > 0; });
    std::vector<std::vector<std::string>> rows;
    for (const auto& cell : report.at("cells")) {
        if (cell.at("status") != "ok") continue;
        const auto& p = cell.at("params");
        const auto& wall = cell.at("statistics").at("wall_ns");
        std::vector<std::string> row{p.at("scene").get<std::string>(),
                                     p.at("lights").dump(),
                                     size_text(p),
                                     path_text(cell),
                                     p.at("layout").is_null() ? "" : p.at("layout").get<std::string>(),
                                     lists_text(cell.at("light_lists")),
                                     p.at("hdr").get<std::string>(),
                                     skip_text(cell),
                                     p.at("guards").get<std::string>(),
                                     p.at("sums").get<std::string>(),
                                     time_text(wall.at("median").get<double>()),
                                     interval_text(wall)};
        std::ranges::move(error_columns(cell.at("error")), std::back_inserter(row));
        if (any_lost) row.push_back(std::to_string(lost_px(cell)));
        row.push_back(cell.at("work").at("target_bytes_per_px").dump());
        rows.push_back(std::move(row));
    }
    std::vector<std::string> header = names;
    header.insert(header.end(), {"time", "95 %", "FLIP", "RMSE", "normal", "packing"});
    if (any_lost) header.emplace_back("lost");
    header.emplace_back("B/px");
    std::string shared;
    for (size_t column = names.size(); column-- > 0 && rows.size() > 1;) {
        const std::string& value = rows.front()[column];
        if (!std::ranges::all_of(rows, [&](const auto& row) { return row[column] == value; })) continue;
        const bool goes_without_saying =
            value.empty() || value == kSkipEverything || value == kGuards.front() || value == kSums.front();
        if (!goes_without_saying) {
            shared = fmt::format("{} {}{}", names[column], value, shared.empty() ? "" : ", ") + shared;
        }
        header.erase(header.begin() + static_cast<std::ptrdiff_t>(column));
        for (auto& row : rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    }
    Table table(std::move(header));
    for (auto& row : rows) table.add(std::move(row));
    return (shared.empty() ? "" : "all cells: " + shared + "\n") + table.text() +
           "time: median frame with its interval; errors of the display picture against the reference: mean FLIP, "
           "RMSE;\n"
           "normal: mean angle of the decoded normals in degrees; packing: its share of the squared error\n" +
           (any_lost ? "lost: pixels that only one of layout and reference takes for covered, or that hold no number\n"
                     : "");
}

std::string rivals_text(const Json& rivals) {
    constexpr size_t kMostShown = 3;
    std::string text = rivals.empty() ? "surely" : "perhaps ";
    for (size_t i = 0; i < std::min(rivals.size(), kMostShown); ++i) {
        text += (i == 0 ? "" : ", ") + rivals[i].at("path").get<std::string>();
    }
    if (rivals.size() > kMostShown) text += fmt::format(" and {} more", rivals.size() - kMostShown);
    return text;
}

std::string fastest_text(const Json& report) {
    Table table({"scene", "size", "overlap", "lights", "fastest", "surely, or perhaps"});
    for (const auto& entry : report.at("fastest")) {
        for (const auto& range : entry.at("ranges")) {
            const int from = range.at("from_lights").get<int>(), to = range.at("to_lights").get<int>();
            table.add({entry.at("scene").get<std::string>(), size_text(entry), overlap_text(entry),
                       from == to ? std::to_string(from) : fmt::format("{} - {}", from, to), arm_text(range.at("arm")),
                       rivals_text(range.at("rivals"))});
        }
    }
    return table.size() == 0 ? "" : "\nfastest\n" + table.text();
}

// Those against forward, and those where the fastest arm changes; the report has more.
std::string crossover_text(const Json& report) {
    Table table({"scene", "size", "overlap", "path", "against", "lights", "95 % interval, or why none"});
    const auto end_text = [](const Json& end) {
        return end.is_null() ? std::string("?") : fmt::format("{:.1f}", end.get<double>());
    };
    for (const auto& c : report.at("crossovers")) {
        if (c.at("b").at("path") != kBaselinePath && !c.at("on_envelope").get<bool>()) continue;
        const bool found = !c.at("lights").is_null();
        table.add({c.at("scene").get<std::string>(), size_text(c), overlap_text(c), arm_text(c.at("a")),
                   arm_text(c.at("b")), found ? fmt::format("{:.1f}", c.at("lights").get<double>()) : "none",
                   found ? fmt::format("[{}, {}]", end_text(c.at("low")), end_text(c.at("high")))
                         : c.at("reason").get<std::string>()});
    }
    return table.size() == 0 ? "" : "\ncrossovers (the light count where both take the same time)\n" + table.text();
}

// A line for each, but one for all that were not drawn since their arm was too slow already.
std::string failures_text(const Json& report) {
    std::string text;
    int too_slow = 0, not_drawn = 0;
    for (const auto& cell : report.at("cells")) {
        if (cell.at("status") == "ok") continue;
        const bool asked_for = !cell.at("too_slow_at_lights").is_null();
        if (asked_for) ++(cell.at("status") == "timeout" ? too_slow : not_drawn);
        if (asked_for && cell.at("status") != "timeout") continue;
        text += fmt::format("  {}: {}: {}\n", cell.at("name").get<std::string>(), cell.at("status").get<std::string>(),
                            cell.at("reason").get<std::string>());
    }
    if (too_slow + not_drawn > 0) {
        text += fmt::format("  {} cells were too slow to sample; {} with as many lights or more were not drawn\n",
                            too_slow, not_drawn);
    }
    return text.empty() ? "" : "\nnot measured\n" + text;
}

}  // namespace

std::string summary_text(const Json& report) {
    std::string text = cell_table(report) + fastest_text(report) + crossover_text(report) + skip_savings_text(report) +
                       failures_text(report);
    const auto& run = report.at("run");
    text += fmt::format("\ntimer: {}; ", report.at("timer").at("method").get<std::string>());
    const auto& floor = report.at("noise").at("floor");
    text += floor.is_null() ? "noise floor: unknown" : fmt::format("noise floor: {:.2f} %", 100 * floor.get<double>());
    if (!run.at("frames_share").is_null()) {
        text += fmt::format("; {:.0f} % of {:.0f} s was spent in frames", 100 * run.at("frames_share").get<double>(),
                            run.at("wall_s").get<double>());
    }
    return text + "\n";
}

std::string answers_text(const Json& report) {
    std::string text;
    std::string group;
    for (const auto& answer : report.at("answers")) {
        if (answer.at("group") != group) {
            group = answer.at("group").get<std::string>();
            text += "\n" + group + "\n";
        }
        text += "  " + answer.at("statement").get<std::string>() + "\n";
    }
    return text;
}

}  // namespace lightsweep
