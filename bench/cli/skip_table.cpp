#include "bench/cli/skip_table.h"

#include "bench/cli/table.h"
#include "bench/plan/cell.h"
#include "renderer/base/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace lightsweep {
namespace {

// Three significant digits of a count: `950`, `1.24k`, `-3.1M`.
std::string count_text(double count) {
    const std::pair<double, const char*> units[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
    for (const auto& [unit, name] : units) {
        if (std::abs(count) >= 0.9995 * unit) return fmt::format("{:.3g}{}", count / unit, name);
    }
    return fmt::format("{:g}", count);
}

// What is not 0, in short; the counts of a skip that finds less to do than it makes are below 0.
std::string work_text(const Json& saved) {
    constexpr std::pair<const char*, const char*> kCounts[] = {{"instances", "instances"},
                                                               {"triangles", "triangles"},
                                                               {"lights", "lights"},
                                                               {"light_evaluations", "evaluations"},
                                                               {"moved_bytes_per_px", "B/px"}};
    std::string text;
    for (const auto& [key, name] : kCounts) {
        const Json& count = saved.at(key);
        if (count.is_null() || count.get<int64_t>() == 0) continue;
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count_text(count.get<double>()));
    }
    return text.empty() ? "-" : text;
}

// In per cent of the time without it; above 0: it saves.
std::string percent_text(const Json& ratio) {
    return ratio.is_null() ? "?" : fmt::format("{:.1f}", 100.0 * (1.0 - ratio.get<double>()));
}

std::string verdict_text(const Json& saving) {
    const auto verdict = saving.at("verdict").get<std::string>();
    if (verdict == "faster") return "saves";
    if (verdict == "slower") return "costs";
    return verdict == "same" ? "same" : "unsure";
}

// In per cent, the ends of what was saved; `-` where too few frames bound it.
std::string interval_text(const Json& saving) {
    const Json &low = saving.at("low"), &high = saving.at("high");
    return low.is_null() && high.is_null() ? "-" : fmt::format("{} to {}", percent_text(high), percent_text(low));
}

std::string picture_text(const Json& proof) {
    if (proof.is_null()) return "-";
    if (proof.at("same_bits").get<bool>()) return "same bits";
    const Json& difference = proof.at("max_abs");
    return difference.is_null() ? "not finite" : fmt::format("{:.1e} off", difference.get<double>());
}

std::string beside_text(const Json& saving) {
    const auto others = saving.at("others").get<std::string>();
    if (others == "all") return "off from all";
    return others == "none" ? "on from none" : "beside " + others;
}

std::string title_of(const Json& saving) {
    std::string title = fmt::format("skips: {}, {} lights, {}x{}, {}", saving.at("scene").get<std::string>(),
                                    saving.at("lights").dump(), saving.at("width_px").dump(),
                                    saving.at("height_px").dump(), saving.at("path").get<std::string>());
    if (!saving.at("overlap").is_null()) title += fmt::format(", overlap {}", saving.at("overlap").dump());
    if (!saving.at("layout").is_null()) title += ", " + saving.at("layout").get<std::string>();
    if (!saving.at("light_lists").is_null()) {
        title += fmt::format(", {} lists", saving.at("light_lists").get<std::string>());
    }
    title += ", " + saving.at("hdr").get<std::string>();
    if (saving.at("guards") != kGuards.front()) title += ", guards " + saving.at("guards").get<std::string>();
    if (saving.at("sums") != kSums.front()) title += fmt::format(", {} sums", saving.at("sums").get<std::string>());
    return title;
}

std::string speed_text(const Json& saving) {
    const Json& ratio = saving.at("ratio");
    if (saving.at("same_work").get<bool>()) return "same work";
    if (ratio.is_null()) return "no time";
    return fmt::format("{:.3g} times as fast, {} % saved [{}]", 1.0 / ratio.get<double>(), percent_text(ratio),
                       interval_text(saving));
}

// `all` or `auto` against none.
std::string whole_set_line(const Json& saving) {
    return fmt::format("{} against none: {}; {}; {}\n", saving.at("skip").get<std::string>(), speed_text(saving),
                       work_text(saving.at("saved_work")), picture_text(saving.at("proof")));
}

std::vector<std::string> row_of(const Json& saving) {
    const Json& ratio = saving.at("ratio");
    return {saving.at("skip").get<std::string>(),
            beside_text(saving),
            ratio.is_null() ? "-" : percent_text(ratio),
            interval_text(saving),
            verdict_text(saving),
            picture_text(saving.at("proof")),
            work_text(saving.at("saved_work"))};
}

// In the order of their table; what is off from all before what is on from none.
std::vector<const Json*> in_order(std::vector<const Json*> savings) {
    const auto place = [](const Json* saving) {
        const auto key = saving->at("skip").get<std::string>();
        return std::pair(std::ranges::find(skip_infos(), key, &SkipInfo::key) - skip_infos().begin(),
                         saving->at("others").get<std::string>());
    };
    std::ranges::stable_sort(savings, {}, place);
    return savings;
}

// Of one arm. The skips that find nothing to do share a line.
std::string arm_text(const std::vector<const Json*>& savings) {
    Table table({"skip", "", "saved %", "95 %", "verdict", "picture", "work saved"});
    std::map<std::string, std::string> idle;  // by what the others do
    std::string whole_sets;
    for (const Json* saving : in_order(savings)) {
        const auto skip = saving->at("skip").get<std::string>();
        if (!std::ranges::count(skip_infos(), skip, &SkipInfo::key)) {
            whole_sets += whole_set_line(*saving);
        } else if (saving->at("same_work").get<bool>()) {
            std::string& names = idle[beside_text(*saving)];
            names += (names.empty() ? "" : ", ") + skip;
        } else {
            table.add(row_of(*saving));
        }
    }
    std::string text = "\n" + title_of(*savings.front()) + "\n" + (table.size() > 0 ? table.text() : "");
    for (const auto& [beside, names] : idle) text += fmt::format("same work, {}: {}\n", beside, names);
    return text + whole_sets;
}

}  // namespace

std::string skip_savings_text(const Json& report) {
    std::vector<std::pair<std::string, std::vector<const Json*>>> arms;
    for (const auto& saving : report.at("skips")) {
        const std::string title = title_of(saving);
        auto arm = arms.begin();
        while (arm != arms.end() && arm->first != title) ++arm;
        if (arm == arms.end()) arm = arms.insert(arm, {title, {}});
        arm->second.push_back(&saving);
    }
    std::string text;
    for (const auto& [title, savings] : arms) text += arm_text(savings);
    if (text.empty()) return text;
    return text +
           "saved: time of a frame, less its time with the skip, as a share of it without; off from all: all skips "
           "against\nall but this one; on from none: this one against none; same work: the skip finds nothing to do; "
           "picture: the\nlargest difference of linear values that the skip makes\n";
}

}  // namespace lightsweep
