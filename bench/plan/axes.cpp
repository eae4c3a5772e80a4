#include "bench/plan/axes.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/json_reader.h"
#include "renderer/base/names.h"
#include "renderer/base/resources.h"
#include "renderer/base/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace lightsweep {
namespace {

constexpr int kMaxPower = 20;
static_assert(1 << kMaxPower == kMaxLights);

std::vector<std::string> path_keys(const Catalog& catalog) {
    std::vector<std::string> keys;
    for (const auto& path : catalog.paths) keys.push_back(path.key);
    return keys;
}

// pow2:FROM:TO -> 2^FROM ... 2^TO
std::vector<std::string> powers_of_two(const std::string& token) {
    const auto parts = split(token, ':');
    const auto exponent = [](const std::string& text) {
        int value = -1;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        return error == std::errc{} && end == text.data() + text.size() ? value : -1;
    };
    const int from = parts.size() == 3 ? exponent(parts[1]) : -1;
    const int to = parts.size() == 3 ? exponent(parts[2]) : -1;
    if (from < 0 || to < from || to > kMaxPower) {
        throw InputError("lights=" + token,
                         fmt::format("not a range; allowed: pow2:FROM:TO with 0 <= FROM <= TO <= {}", kMaxPower));
    }
    std::vector<std::string> values;
    for (int power = from; power <= to; ++power) values.push_back(std::to_string(1 << power));
    return values;
}

void check_file_or_key(const CellField& axis, const std::string& value, const std::vector<std::string>& keys,
                       std::string_view folder, const std::vector<std::string>& extensions) {
    if (std::find(keys.begin(), keys.end(), value) != keys.end()) return;
    try {
        find_resource(axis.name, value, folder, extensions);
    } catch (const InputError& error) {
        throw InputError(axis.name + "=" + value, error.what());
    }
}

// That the thing a value names exists.
void check_exists(const CellField& axis, const std::string& value, const Catalog& catalog) {
    if (axis.name == "scene") check_file_or_key(axis, value, catalog.scenes, "scenes", {".json", ".gltf", ".glb"});
    if (axis.name == "layout") check_file_or_key(axis, value, catalog.layouts, "shaders/gbuffer/layouts", {".json"});
    if (axis.name == "path" && value != kAutoPath) {
        auto keys = path_keys(catalog);
        keys.emplace_back(kAutoPath);
        if (std::find(keys.begin(), keys.end(), value) == keys.end()) {
            throw InputError("path=" + value, unknown_name("path", value, keys));
        }
    }
}

// The names `*` stands for; empty for an axis of numbers.
std::vector<std::string> every_value(const CellField& axis, const Catalog& catalog) {
    if (axis.name == "scene") return catalog.scenes;
    if (axis.name == "path") return path_keys(catalog);
    if (axis.name == "layout") return catalog.layouts;
    if (axis.name == "light_lists") return {kLightListBuilders.begin() + 1, kLightListBuilders.end()};
    if (axis.name == "hdr") return kHdrFormats;
    if (axis.name == "skip") return {SkipSet::all().text(), SkipSet::none().text()};
    if (axis.name == "guards") return kGuards;
    if (axis.name == "sums") return kSums;
    return {};
}

// all-*: without each skip in turn; none+*: with it alone. In the order of their table.
std::vector<std::string> one_skip_each(bool without) {
    std::vector<std::string> values;
    for (const auto& info : skip_infos()) {
        const SkipSet set = without ? SkipSet::all().without(info.skip) : SkipSet::none().with(info.skip);
        values.push_back(set.text());
    }
    return values;
}

// One word without commas to the values it stands for.
std::vector<std::string> expand(const CellField& axis, const std::string& token, const Catalog& catalog) {
    if (axis.name == "lights" && token.starts_with("pow2:")) return powers_of_two(token);
    if (axis.name == "skip" && (token == "all-*" || token == "none+*")) return one_skip_each(token == "all-*");
    if (token == "*") {
        if (auto values = every_value(axis, catalog); !values.empty()) return values;
    }
    CellParams scratch;
    set_cell_field(scratch, axis, token);
    check_exists(axis, token, catalog);
    return {token};
}

std::vector<std::string> expand_all(const CellField& axis, const std::vector<std::string>& tokens,
                                    const Catalog& catalog) {
    if (tokens.empty()) throw InputError(axis.name, "no value; allowed: " + axis.allowed);
    std::vector<std::string> values;
    for (const auto& token : tokens) {
        for (auto& value : expand(axis, token, catalog)) values.push_back(std::move(value));
    }
    return values;
}

}  // namespace

bool Catalog::uses(const std::string& path, const CellField& axis) const {
    if (path == kAutoPath) return true;
    const auto found = std::find_if(paths.begin(), paths.end(), [&](const PathName& p) { return p.key == path; });
    CHECK_THAT(found != paths.end(), "path = {}", path);
    if (axis.name == "layout") return found->uses_layout;
    if (axis.name == "light_lists") return found->uses_light_lists;
    return true;
}

Catalog shipped_catalog(std::vector<PathName> paths) {
    return {std::move(paths), resource_keys("shaders/gbuffer/layouts", ".json"), resource_keys("scenes", ".json")};
}

std::vector<std::string> parse_axis_values(const CellField& axis, const std::string& text, const Catalog& catalog) {
    return expand_all(axis, split(text, ','), catalog);
}

std::vector<std::string> parse_axis_values(const CellField& axis, const JsonReader& json, const Catalog& catalog) {
    const auto token = [](const JsonReader& element) {
        return element.value().is_number() ? element.value().dump() : element.string();
    };
    try {
        if (json.value().is_string()) return parse_axis_values(axis, json.string(), catalog);
        if (json.value().is_number()) return expand_all(axis, {token(json)}, catalog);
        std::vector<std::string> tokens;
        for (const auto& element : json.elements()) tokens.push_back(token(element));
        return expand_all(axis, tokens, catalog);
    } catch (const InputError& error) {
        // The reader's own failures already name the place.
        if (std::string_view(error.what()).starts_with(json.where())) throw;
        json.fail(error.what());
    }
}

AxisValues parse_axis_arguments(const std::vector<std::string>& arguments, const Catalog& catalog) {
    AxisValues values;
    for (const auto& argument : arguments) {
        const size_t equals = argument.find('=');
        if (equals == std::string::npos) {
            throw InputError("-a " + argument, "not an axis with values; allowed: axis=values, as in lights=1,16,256");
        }
        const CellField& axis = find_cell_field(argument.substr(0, equals));
        if (values.contains(axis.name)) {
            throw InputError("-a " + argument, "the axis is given twice; write its values in one list");
        }
        values[axis.name] = parse_axis_values(axis, argument.substr(equals + 1), catalog);
    }
    return values;
}

std::vector<std::string> default_axis_values(const CellField& axis, const Catalog& catalog) {
    static const std::map<std::string, std::string> otherwise{
        {"lights", "default"},        {"size", "640x360"},
        {"overlap", "scene"},         {"path", "*"},
        {"layout", "oct32"},          {"light_lists", kAutoLightLists},
        {"hdr", kHdrFormats.front()}, {"skip", kSkipEverything},
        {"guards", kGuards.front()},  {"sums", kSums.front()},
    };
    const auto found = otherwise.find(axis.name);
    if (found == otherwise.end())
        throw InputError(axis.name, "no value, and it has no default; allowed: " + axis.allowed);
    return parse_axis_values(axis, found->second, catalog);
}

}  // namespace lightsweep
