// lightsweep list: what there is. Only `list devices` makes a GL context.
#include "bench/cli/commands.h"
#include "bench/cli/table.h"
#include "bench/metrics/metrics.h"
#include "bench/plan/sweep.h"
#include "bench/stress/cases.h"
#include "renderer/base/json_reader.h"
#include "renderer/base/names.h"
#include "renderer/base/resources.h"
#include "renderer/base/skips.h"
#include "renderer/gbuffer/encoding.h"
#include "renderer/gbuffer/layout.h"
#include "renderer/gl/context.h"
#include "renderer/paths/paths.h"
#include "renderer/paths/view.h"
#include "renderer/post/post.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;

// A list of objects with the same keys: the JSON as it is, the table from it.
Json key_and_summary(const auto& entries) {
    Json list = Json::array();
    for (const auto* entry : entries) list.push_back({{"key", entry->key}, {"summary", entry->summary}});
    return list;
}

Json data_files(const char* folder) {
    Json list = Json::array();
    for (const auto& key : resource_keys(folder, ".json")) {
        const auto json = JsonReader::from_file(resource(folder) / (key + ".json"));
        list.push_back({{"key", key}, {"summary", json.string_or("summary", "")}});
    }
    return list;
}

Json layouts() {
    Json list = Json::array();
    for (const auto& key : layout_keys()) {
        const Layout layout = load_layout(key);
        list.push_back({{"key", key}, {"bytes_per_px", layout.bytes_per_pixel()}, {"summary", layout.summary}});
    }
    return list;
}

Json encodings() {
    Json list = Json::array();
    for (const auto& key : encoding_keys()) {
        const Encoding encoding = load_encoding(key);
        std::string fields;
        for (const auto& field : encoding.fields) fields += (fields.empty() ? "" : " ") + field;
        list.push_back({{"key", key}, {"fields", fields}, {"summary", encoding.summary}, {"source", encoding.source}});
    }
    return list;
}

Json devices() {
    Json list = Json::array();
    for (const auto& device : gl::list_devices()) {
        list.push_back({{"key", device.key},
                        {"available", device.available},
                        {"software", device.available ? Json(device.software) : Json()},
                        {"renderer", device.renderer},
                        {"version", device.version},
                        {"reason", device.reason}});
    }
    return list;
}

Json views() {
    Json list = Json::array();
    for (const auto& view : view_names()) list.push_back({{"key", view}});
    return list;
}

Json skips() {
    Json list = Json::array();
    for (const auto& info : skip_infos()) {
        list.push_back({{"key", info.key}, {"same_bits", info.same_bits}, {"what", info.what}});
    }
    return list;
}

// An arm may have a bound of its own. Of a ratio or an angle none else is 0.
std::string bound_text(const StressCase& stress_case) {
    const bool by_arm = stress_case.bound == 0.0 && (stress_case.unit == "rel" || stress_case.unit == "deg");
    return by_arm ? "by arm" : fmt::format("{:.3g} {}", stress_case.bound, stress_case.unit);
}

Json stress() {
    Json list = Json::array();
    for (const StressCase* stress_case : all_stress_cases()) {
        Json parameter;  // null: there is none
        if (const auto& turned = stress_case->parameter) {
            parameter = fmt::format("{}, {:g} to {:g}{}{}", turned->name, turned->easy, turned->hard,
                                    turned->unit.empty() ? "" : " ", turned->unit);
        }
        list.push_back({{"id", stress_case->id},
                        {"summary", stress_case->summary},
                        {"parameter", std::move(parameter)},
                        {"bound", bound_text(*stress_case)}});
    }
    return list;
}

const std::vector<std::pair<std::string, Json (*)()>> kLists = {
    {"paths", [] { return key_and_summary(all_paths()); }},
    {"layouts", layouts},
    {"encodings", encodings},
    {"scenes", [] { return data_files("scenes"); }},
    {"metrics", [] { return key_and_summary(all_metrics()); }},
    {"post", [] { return key_and_summary(all_post_effects()); }},
    {"sweeps", [] { return data_files("bench/sweeps"); }},
    {"skips", skips},
    {"stress", stress},
    {"views", views},
    {"devices", devices},
};

std::string cell_text(const Json& value) {
    if (value.is_null()) return "";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

void print_table(const Json& list) {
    if (list.empty()) return;
    std::vector<std::string> header;
    for (const auto& [key, value] : list.front().items()) header.push_back(key);
    Table table(header);
    for (const auto& entry : list) {
        std::vector<std::string> row;
        for (const auto& key : header) row.push_back(cell_text(entry.at(key)));
        table.add(std::move(row));
    }
    fmt::print("{}", table.text());
}

}  // namespace

Command add_list(CLI::App& app) {
    struct Options {
        std::string what;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("list", "what there is: paths, layouts, encodings, scenes, metrics, ...");
    command->add_option("what", options->what, "which list; all but devices when left out");
    command->add_flag("--json", options->json, "for programs");
    return [options] {
        std::vector<std::string> names;
        for (const auto& [name, make] : kLists) names.push_back(name);
        if (!options->what.empty() && std::find(names.begin(), names.end(), options->what) == names.end()) {
            throw InputError(unknown_name("list", options->what, names));
        }
        Json all;
        for (const auto& [name, make] : kLists) {
            if (options->what.empty() ? name != "devices" : name == options->what) all[name] = make();
        }
        if (options->json) {
            fmt::print("{}\n", (options->what.empty() ? all : all.at(options->what)).dump(2));
            return kDone;
        }
        for (const auto& [name, list] : all.items()) {
            if (options->what.empty()) fmt::print("{}\n", name);
            print_table(list);
            if (options->what.empty()) fmt::print("\n");
        }
        return kDone;
    };
}

}  // namespace lightsweep
