// lightsweep needs: what a scene needs from a renderer, and what may be skipped for it. No GL context.
#include "bench/cli/commands.h"
#include "bench/cli/table.h"
#include "renderer/frame/skip_needs.h"
#include "renderer/gbuffer/field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <concepts>
#include <memory>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;

Json fields_json(const SceneNeeds& needs) {
    Json fields = Json::object();
    const auto& names = field_names();
    for (size_t i = 0; i < names.size(); ++i) fields[names[i]] = info(static_cast<Field>(i)).needed(needs);
    return fields;
}

Json skips_json(const SceneNeeds& needs) {
    Json skips = Json::array();
    for (const auto& info : skip_infos()) {
        const SkipUse use = skip_use(info.skip, needs);
        skips.push_back({{"key", info.key}, {"may_help", use.may_help}, {"why", use.why}});
    }
    return skips;
}

Json needs_json(const Scene& scene, const SceneNeeds& needs) {
    Json by_name = Json::object();
    visit_needs(needs, [&](std::string_view name, auto value) {
        if constexpr (std::same_as<decltype(value), bool>) by_name[std::string(name)] = value;
    });
    return {{"scene", scene.key},
            {"summary", scene.summary},
            {"instances", needs.instances},
            {"triangles", needs.triangles},
            {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},
            {"needs", std::move(by_name)},
            {"defines", needs.defines()},
            {"fields", fields_json(needs)},
            {"skips", skips_json(needs)}};
}

// The keys whose value is `wanted`: "base color textures, emissive".
std::string keys_text(const Json& flags, bool wanted) {
    std::vector<std::string> words;
    for (const auto& [key, value] : flags.items()) {
        if (value.get<bool>() != wanted) continue;
        words.push_back(key);
        std::ranges::replace(words.back(), '_', ' ');
    }
    return words.empty() ? "nothing" : fmt::format("{}", fmt::join(words, ", "));
}

std::string count_text(const Json& json, const char* plural) {
    const auto count = json.at(plural).get<uint64_t>();
    const std::string word(plural);
    return fmt::format("{} {}", count, count == 1 ? word.substr(0, word.size() - 1) : word);
}

void print_needs(const Json& json) {
    fmt::print("{}: {}\n", json.at("scene").get<std::string>(), json.at("summary").get<std::string>());
    fmt::print("{}, {}, {}, {}\n\n", count_text(json, "instances"), count_text(json, "triangles"),
               count_text(json, "materials"), count_text(json, "textures"));
    Table needs({"need", ""});
    for (const auto& [key, value] : json.at("needs").items()) {
        std::string words = key;
        std::ranges::replace(words, '_', ' ');
        needs.add({words, value.get<bool>() ? "yes" : "no"});
    }
    fmt::print("{}\n", needs.text());
    fmt::print("shaders are compiled with: {}\n", fmt::join(json.at("defines").get<std::vector<std::string>>(), " "));
    fmt::print("a G-buffer stores: {}; it drops: {}\n\n", keys_text(json.at("fields"), true),
               keys_text(json.at("fields"), false));
    Table skips({"skip", "may help", "since"});
    for (const auto& skip : json.at("skips")) {
        skips.add({skip.at("key").get<std::string>(), skip.at("may_help").get<bool>() ? "yes" : "no",
                   skip.at("why").get<std::string>()});
    }
    fmt::print("{}", skips.text());
}

}  // namespace

Command add_needs(CLI::App& app) {
    struct Options {
        std::string scene;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("needs", "what a scene needs, and which skips have something to do in it");
    command->add_option("scene", options->scene, "key, or a .json, .gltf or .glb file")->required();
    command->add_flag("--json", options->json, "for programs");
    return [options] {
        const Scene scene = load_scene(options->scene);
        const Json json = needs_json(scene, scene_needs(scene));
        for (const auto& warning : scene.warnings) fmt::print(stderr, "warning: {}\n", warning);
        if (options->json) {
            fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
        } else {
            print_needs(json);
        }
        return kDone;
    };
}

}  // namespace lightsweep
