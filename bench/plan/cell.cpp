#include "bench/plan/cell.h"

#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/base/names.h"
#include "renderer/base/skips.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lightsweep {

const std::vector<std::string> kHdrFormats{"rgba16f", "rgba32f", "r11g11b10f"};
const std::vector<std::string> kLightListBuilders{kAutoLightLists, "cpu", "compute"};
const std::vector<std::string> kGuards{"on", "off"};
const std::vector<std::string> kSums{"plain", kCompensatedSums};

namespace {

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

// A '=' or a line break inside a value would make the cell's name ambiguous.
bool set_word(std::string& field, const std::string& value) {
    const bool printable =
        std::none_of(value.begin(), value.end(), [](unsigned char c) { return c < 0x20 || c == '='; });
    if (value.empty() || !printable) return false;
    field = value;
    return true;
}

bool set_lights(CellParams& cell, const std::string& value) {
    if (value == "default") {
        cell.lights.reset();
        return true;
    }
    const auto count = parse_number<int>(value);
    if (!count || *count < 0 || *count > kMaxLights) return false;
    cell.lights = count;
    return true;
}

bool set_size(CellParams& cell, const std::string& value) {
    const auto parts = split(value, 'x');
    if (parts.size() != 2) return false;
    const auto width = parse_number<int>(parts[0]);
    const auto height = parse_number<int>(parts[1]);
    const auto fits = [](std::optional<int> px) { return px && *px >= 1 && *px <= kMaxExtentPx; };
    if (!fits(width) || !fits(height)) return false;
    cell.width = *width;
    cell.height = *height;
    return true;
}

bool set_overlap(CellParams& cell, const std::string& value) {
    if (value == "scene") {
        cell.overlap.reset();
    } else if (value == "fixed") {
        cell.overlap = 0.0;
    } else {
        const auto k = parse_number<double>(value);
        if (!k || !std::isfinite(*k) || *k <= 0.0 || *k > kMaxLights) return false;
        cell.overlap = k;
    }
    return true;
}

bool set_one_of(const std::vector<std::string>& allowed, std::string& field, const std::string& value) {
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) return false;
    field = value;
    return true;
}

std::vector<std::string> skip_keys() {
    std::vector<std::string> keys;
    for (const auto& info : skip_infos()) keys.emplace_back(info.key);
    return keys;
}

const std::string& allowed_skips() {
    static const std::string allowed =
        fmt::format("auto, or all or none followed by -KEY or +KEY; keys: {}", fmt::join(skip_keys(), ", "));
    return allowed;
}

// The first word that is not what may stand there, with the nearest that may.
[[noreturn]] void refuse_skips(const std::string& value) {
    const auto refuse = [&](std::string_view word, const std::vector<std::string>& names) {
        const std::string near = nearest_name(word, names);
        const std::string hint = near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near);
        throw InputError("skip=" + value,
                         fmt::format("'{}' is not allowed{}; allowed: {}", word, hint, allowed_skips()));
    };
    std::vector<std::string> names{kAutoSkip, "all", "none"};
    for (size_t begin = 0; begin <= value.size(); names = skip_keys()) {
        const size_t end = std::min(value.find_first_of("+-", begin), value.size());
        const std::string word = value.substr(begin, end - begin);
        if (std::ranges::find(names, word) == names.end()) refuse(word, names);
        begin = end + 1;
    }
    throw InputError("skip=" + value, "auto takes no keys; allowed: " + allowed_skips());
}

bool set_skip(CellParams& cell, const std::string& value) {
    const auto set = parse_skips(value);
    if (!set && value != kAutoSkip) refuse_skips(value);
    cell.skip = set ? set->text() : value;
    return true;
}

std::string overlap_text(const CellParams& cell) {
    if (!cell.overlap) return {};
    return *cell.overlap == 0.0 ? "fixed" : fmt::format("{}", *cell.overlap);
}

std::string join_fields(const CellParams& cell, bool only_group) {
    std::string line;
    for (const auto& field : cell_fields()) {
        if (only_group && !field.of_group) continue;
        if (const std::string text = field.text(cell); !text.empty()) {
            line += fmt::format("{}{}={}", line.empty() ? "" : " ", field.name, text);
        }
    }
    return line;
}

}  // namespace

const std::vector<CellField>& cell_fields() {
    static const std::vector<CellField> fields{
        {.name = "scene",
         .allowed = "a scene's key, or the path (without '=') of a .json, .gltf or .glb file",
         .of_group = true,
         .text = [](const CellParams& c) { return c.scene; },
         .set = [](CellParams& c, const std::string& v) { return set_word(c.scene, v); }},
        {.name = "lights",
         .allowed = fmt::format("a whole number from 0 to {}, or default", kMaxLights),
         .of_group = true,
         .text = [](const CellParams& c) { return c.lights ? std::to_string(*c.lights) : "default"; },
         .set = set_lights},
        {.name = "size",
         .allowed = fmt::format("WIDTHxHEIGHT, each from 1 to {} px", kMaxExtentPx),
         .of_group = true,
         .text = [](const CellParams& c) { return fmt::format("{}x{}", c.width, c.height); },
         .set = set_size},
        {.name = "overlap",
         .allowed = fmt::format("fixed, scene, or a number above 0 and at most {}", kMaxLights),
         .of_group = true,
         .text = overlap_text,
         .set = set_overlap},
        {.name = "path",
         .allowed = "a path's key, or auto",
         .of_group = false,
         .text = [](const CellParams& c) { return c.path; },
         .set = [](CellParams& c, const std::string& v) { return set_word(c.path, v); }},
        {.name = "layout",
         .allowed = "a layout's key, or the path (without '=') of a .json file",
         .of_group = false,
         .text = [](const CellParams& c) { return c.layout; },
         .set = [](CellParams& c, const std::string& v) { return set_word(c.layout, v); }},
        {.name = "light_lists",
         .allowed = "auto, cpu or compute",
         .of_group = false,
         .text = [](const CellParams& c) { return c.light_lists; },
         .set = [](CellParams& c, const std::string& v) { return set_one_of(kLightListBuilders, c.light_lists, v); }},
        {.name = "hdr",
         .allowed = "rgba16f, rgba32f or r11g11b10f",
         .of_group = false,
         .text = [](const CellParams& c) { return c.hdr; },
         .set = [](CellParams& c, const std::string& v) { return set_one_of(kHdrFormats, c.hdr, v); }},
        {.name = "skip",
         .allowed = allowed_skips(),
         .of_group = false,
         .text = [](const CellParams& c) { return c.skip == kSkipEverything ? std::string() : c.skip; },
         .set = set_skip},
        {.name = "guards",
         .allowed = "on or off",
         .of_group = false,
         .text = [](const CellParams& c) { return c.guards == kGuards.front() ? std::string() : c.guards; },
         .set = [](CellParams& c, const std::string& v) { return set_one_of(kGuards, c.guards, v); }},
        {.name = "sums",
         .allowed = "plain or compensated",
         .of_group = false,
         .text = [](const CellParams& c) { return c.sums == kSums.front() ? std::string() : c.sums; },
         .set = [](CellParams& c, const std::string& v) { return set_one_of(kSums, c.sums, v); }},
    };
    return fields;
}

std::vector<std::string> switched(const CellParams& cell) {
    std::vector<std::string> words;
    for (const char* name : {"skip", "guards", "sums"}) {
        if (const std::string text = find_cell_field(name).text(cell); !text.empty()) {
            words.push_back(fmt::format("{}={}", name, text));
        }
    }
    return words;
}

const CellField& find_cell_field(std::string_view name) {
    const auto& fields = cell_fields();
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const CellField& f) { return f.name == name; });
    if (found != fields.end()) return *found;
    std::vector<std::string> names;
    for (const auto& field : fields) names.push_back(field.name);
    throw InputError(unknown_name("axis", name, names));
}

void set_cell_field(CellParams& cell, const CellField& field, const std::string& value) {
    if (field.set(cell, value)) return;
    throw InputError(field.name + "=" + value, "not allowed; allowed: " + field.allowed);
}

std::string CellParams::name() const { return join_fields(*this, false); }
std::string CellParams::group() const { return join_fields(*this, true); }
std::string CellParams::id() const { return hash_hex(name()); }

CellParams parse_cell(std::string_view name) {
    CellParams cell;
    // No value holds a '=', so each one marks a word; a value may hold spaces (a file's path).
    size_t begin = 0;
    while (begin < name.size()) {
        const size_t equals = name.find('=', begin);
        if (equals == std::string_view::npos) {
            throw InputError(fmt::format("cell '{}'", name), fmt::format("'{}' is not key=value", name.substr(begin)));
        }
        const size_t next_equals = name.find('=', equals + 1);
        const size_t end = next_equals == std::string_view::npos ? name.size() : name.rfind(' ', next_equals);
        if (end < equals || end == std::string_view::npos) {
            throw InputError(fmt::format("cell '{}'", name),
                             "two '=' in one word; allowed: key=value, separated by spaces");
        }
        set_cell_field(cell, find_cell_field(name.substr(begin, equals - begin)),
                       std::string(name.substr(equals + 1, end - equals - 1)));
        begin = end + 1;
    }
    if (cell.scene.empty() || cell.path.empty()) {
        throw InputError(fmt::format("cell '{}'", name), "the scene or the path is missing");
    }
    return cell;
}

}  // namespace lightsweep
