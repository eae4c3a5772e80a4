#include "bench/cli/summary.h"

#include "bench/cli/table.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

std::string interval_text(const Json& statistics) {
    const auto end = [&](const char* key) {
        return statistics.at(key).is_null() ? std::string("?") : time_text(statistics.at(key).get<double>());
    };
    return fmt::format("[{}, {}]", end("low"), end("high"));
}

std::string number_text(const Json& value) {
    return value.is_null() ? "-" : fmt::format("{:.2e}", value.get<double>());
}

std::string arm_text(const Json& arm) {
    std::string text = arm.at("path").get<std::string>();
    if (!arm.at("layout").is_null()) text += "/" + arm.at("layout").get<std::string>();
    return text + "/" + arm.at("hdr").get<std::string>();
}

std::string cell_table(const Json& report) {
    Table table({"scene", "lights", "size", "path", "layout", "hdr", "time", "95 % interval", "error", "B/px"});
    for (const auto& cell : report.at("cells")) {
        if (cell.at("status") != "ok") continue;
        const auto& p = cell.at("params");
        const auto& wall = cell.at("statistics").at("wall_ns");
        const auto& error = cell.at("error");
        table.add({p.at("scene").get<std::string>(), p.at("lights").dump(),
                   fmt::format("{}x{}", p.at("width_px").get<int>(), p.at("height_px").get<int>()),
                   p.at("path").get<std::string>(), p.at("layout").is_null() ? "" : p.at("layout").get<std::string>(),
                   p.at("hdr").get<std::string>(), time_text(wall.at("median").get<double>()), interval_text(wall),
                   error.is_null() ? "-" : number_text(error.at("display").at("rmse")),
                   cell.at("work").at("target_bytes_per_px").dump()});
    }
    return table.text() + "time: median frame; error: RMSE of display values against the control arm\n";
}

std::string crossover_text(const Json& report) {
    Table table({"scene", "size", "overlap", "path", "against", "lights", "95 % interval, or why none"});
    const auto end_text = [](const Json& end) {
        return end.is_null() ? std::string("?") : fmt::format("{:.1f}", end.get<double>());
    };
    for (const auto& c : report.at("crossovers")) {
        const bool found = !c.at("lights").is_null();
        table.add({c.at("scene").get<std::string>(),
                   fmt::format("{}x{}", c.at("width_px").get<int>(), c.at("height_px").get<int>()),
                   c.at("overlap").is_null() ? "fixed" : c.at("overlap").dump(), arm_text(c.at("a")),
                   arm_text(c.at("b")), found ? fmt::format("{:.1f}", c.at("lights").get<double>()) : "none",
                   found ? fmt::format("[{}, {}]", end_text(c.at("low")), end_text(c.at("high")))
                         : c.at("reason").get<std::string>()});
    }
    return table.size() == 0 ? "" : "\ncrossovers (the light count where both take the same time)\n" + table.text();
}

std::string failures_text(const Json& report) {
    std::string text;
    for (const auto& cell : report.at("cells")) {
        if (cell.at("status") == "ok") continue;
        text += fmt::format("  {}: {}: {}\n", cell.at("name").get<std::string>(), cell.at("status").get<std::string>(),
                            cell.at("reason").get<std::string>());
    }
    return text.empty() ? "" : "\nnot measured\n" + text;
}

}  // namespace

std::string summary_text(const Json& report) {
    std::string text = cell_table(report) + crossover_text(report) + failures_text(report);
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

}  // namespace lightsweep
