#include "renderer/base/json_reader.h"

#include "renderer/base/file.h"
#include "renderer/base/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

// The line and column (from 1) of a byte offset.
std::string place(std::string_view text, size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return fmt::format("{}:{}", line, before.size() - line_start + 1);
}

std::string range_text(double low, double high) {
    if (std::isinf(low) && std::isinf(high)) return "a finite number";
    if (std::isinf(high) || high >= 1e300) return fmt::format("a finite number of at least {}", low);
    return fmt::format("a number from {} to {}", low, high);
}

}  // namespace

void check_nesting(std::string_view text, const std::string& name) {
    constexpr int kDeepest = 100;
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') ++i;
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        if (depth > kDeepest)
            throw InputError(name + ":" + place(text, i), fmt::format("nests deeper than {}", kDeepest));
    }
}

JsonReader JsonReader::from_file(const std::filesystem::path& file) {
    return from_text(read_file(file), file.string());
}

JsonReader JsonReader::from_text(std::string_view text, std::string name) {
    check_nesting(text, name);
    JsonReader reader;
    try {
        // Duplicate keys: nlohmann keeps the last one; a file that means two things is refused instead.
        std::vector<std::vector<std::string>> open_keys;
        std::string duplicate;
        const nlohmann::json::parser_callback_t callback = [&](int, nlohmann::json::parse_event_t event,
                                                               nlohmann::json& parsed) {
            using Event = nlohmann::json::parse_event_t;
            if (event == Event::object_start) open_keys.emplace_back();
            if (event == Event::object_end) open_keys.pop_back();
            if (event == Event::key) {
                auto& keys = open_keys.back();
                const auto key = parsed.get<std::string>();
                if (std::find(keys.begin(), keys.end(), key) != keys.end()) duplicate = key;
                keys.push_back(key);
            }
            return true;
        };
        reader.document_ = std::make_shared<nlohmann::json>(nlohmann::json::parse(text, callback));
        if (!duplicate.empty())
            throw InputError(name, fmt::format("the key '{}' stands twice in one object", duplicate));
    } catch (const nlohmann::json::parse_error& error) {
        std::string what = error.what();
        if (const size_t colon = what.rfind("syntax error"); colon != std::string::npos) what = what.substr(colon);
        throw InputError(name + ":" + place(text, error.byte > 0 ? error.byte - 1 : 0), what);
    } catch (const nlohmann::json::exception& error) {
        throw InputError(name, error.what());
    }
    reader.file_ = std::make_shared<std::filesystem::path>(std::move(name));
    reader.value_ = reader.document_.get();
    return reader;
}

std::string JsonReader::where() const {
    std::string shown = pointer_.empty() ? "/" : pointer_;  // keys may hold line breaks, a message may not
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < 0x20; }, '?');
    return file_->string() + ":" + shown;
}

JsonReader JsonReader::child(const nlohmann::json& value, const std::string& token) const {
    JsonReader reader = *this;
    reader.value_ = &value;
    reader.pointer_ += "/" + token;
    return reader;
}

void JsonReader::allow_keys(std::initializer_list<std::string_view> allowed) const {
    if (!value_->is_object()) fail(fmt::format("an object was expected, not {}", value_->type_name()));
    for (const auto& [key, ignored] : value_->items()) {
        if (key == "$schema" || key == "comment") continue;
        if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
            fail(unknown_name("key", key, std::vector<std::string>(allowed.begin(), allowed.end())));
        }
    }
}

bool JsonReader::has(std::string_view key) const { return value_->is_object() && value_->contains(key); }

JsonReader JsonReader::at(std::string_view key) const {
    if (!value_->is_object()) fail(fmt::format("an object was expected, not {}", value_->type_name()));
    const auto found = value_->find(key);
    if (found == value_->end()) fail(fmt::format("the key '{}' is missing", key));
    return child(*found, std::string(key));
}

std::optional<JsonReader> JsonReader::find(std::string_view key) const {
    if (!has(key)) return std::nullopt;
    return at(key);
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
    if (!value_->is_object()) fail(fmt::format("an object was expected, not {}", value_->type_name()));
    std::vector<std::pair<std::string, JsonReader>> result;
    for (const auto& [key, member] : value_->items()) {
        if (key != "comment") result.emplace_back(key, child(member, key));
    }
    return result;
}

std::vector<JsonReader> JsonReader::elements() const {
    if (!value_->is_array()) fail(fmt::format("a list was expected, not {}", value_->type_name()));
    std::vector<JsonReader> result;
    for (size_t i = 0; i < value_->size(); ++i) result.push_back(child((*value_)[i], std::to_string(i)));
    return result;
}

std::string JsonReader::string() const {
    if (!value_->is_string()) fail(fmt::format("a string was expected, not {}", value_->type_name()));
    return value_->get<std::string>();
}

bool JsonReader::boolean() const {
    if (!value_->is_boolean()) fail(fmt::format("true or false was expected, not {}", value_->type_name()));
    return value_->get<bool>();
}

double JsonReader::number(double low, double high) const {
    if (!value_->is_number()) fail(fmt::format("{} was expected, not {}", range_text(low, high), value_->dump()));
    const auto number = value_->get<double>();
    if (!std::isfinite(number) || number < low || number > high) {
        fail(fmt::format("{} was expected, not {}", range_text(low, high), number));
    }
    return number;
}

int64_t JsonReader::integer(int64_t low, int64_t high) const {
    if (!value_->is_number_integer() || value_->get<int64_t>() < low || value_->get<int64_t>() > high) {
        fail(fmt::format("a whole number from {} to {} was expected, not {}", low, high, value_->dump()));
    }
    return value_->get<int64_t>();
}

std::vector<double> JsonReader::numbers(size_t count, double low, double high) const {
    if (!value_->is_array() || value_->size() != count) {
        fail(fmt::format("a list of {} numbers was expected, not {}", count, value_->dump()));
    }
    std::vector<double> result;
    for (const auto& element : elements()) result.push_back(element.number(low, high));
    return result;
}

size_t JsonReader::choice(std::string_view what, std::span<const std::string> names) const {
    const std::string name = string();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) fail(unknown_name(what, name, names));
    return static_cast<size_t>(found - names.begin());
}

double JsonReader::number_or(std::string_view key, double otherwise, double low, double high) const {
    return has(key) ? at(key).number(low, high) : otherwise;
}
int64_t JsonReader::integer_or(std::string_view key, int64_t otherwise, int64_t low, int64_t high) const {
    return has(key) ? at(key).integer(low, high) : otherwise;
}
std::string JsonReader::string_or(std::string_view key, std::string otherwise) const {
    return has(key) ? at(key).string() : otherwise;
}
bool JsonReader::boolean_or(std::string_view key, bool otherwise) const {
    return has(key) ? at(key).boolean() : otherwise;
}

}  // namespace lightsweep
