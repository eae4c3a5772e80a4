// Reads the project's JSON files strictly: an unknown key, a wrong type, a value out of range or a name that is not
// known is an InputError with the file, the JSON pointer, what is wrong and what is allowed.
#pragma once

#include "renderer/base/error.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

/// Throws InputError, with `name` for the file, where lists and objects of JSON text nest deeper than any file of the
/// program's does: values are copied and printed recursively, and a stack ends.
void check_nesting(std::string_view text, const std::string& name);

/// One value inside a JSON file, and where it stands. Cheap to copy: it shares the parsed document.
class JsonReader {
  public:
    /// Parses a file. A syntax error names file:line:column.
    static JsonReader from_file(const std::filesystem::path& file);
    /// Parses text; `name` stands for the file in messages.
    static JsonReader from_text(std::string_view text, std::string name);

    const nlohmann::json& value() const { return *value_; }
    /// `file:/pointer/to/here`
    std::string where() const;
    const std::filesystem::path& file() const { return *file_; }
    [[noreturn]] void fail(const std::string& what) const { throw InputError(where(), what); }

    /// Fails unless this is an object whose keys are all among `allowed` (`$schema` and `comment` are always allowed).
    void allow_keys(std::initializer_list<std::string_view> allowed) const;
    bool has(std::string_view key) const;
    /// The member `key`; fails when it is missing.
    JsonReader at(std::string_view key) const;
    std::optional<JsonReader> find(std::string_view key) const;
    /// Members of an object with their keys, or elements of an array; fails on anything else.
    std::vector<std::pair<std::string, JsonReader>> members() const;
    std::vector<JsonReader> elements() const;

    std::string string() const;
    bool boolean() const;
    /// A finite number in [low, high].
    double number(double low, double high) const;
    int64_t integer(int64_t low, int64_t high) const;
    /// Exactly `count` finite numbers in [low, high].
    std::vector<double> numbers(size_t count, double low, double high) const;
    /// A string that is one of `names`; returns its index. `what` is the word for the message ("encoding").
    size_t choice(std::string_view what, std::span<const std::string> names) const;

    double number_or(std::string_view key, double otherwise, double low, double high) const;
    int64_t integer_or(std::string_view key, int64_t otherwise, int64_t low, int64_t high) const;
    std::string string_or(std::string_view key, std::string otherwise) const;
    bool boolean_or(std::string_view key, bool otherwise) const;

  private:
    JsonReader child(const nlohmann::json& value, const std::string& token) const;

    std::shared_ptr<const nlohmann::json> document_;
    std::shared_ptr<const std::filesystem::path> file_;
    const nlohmann::json* value_ = nullptr;
    std::string pointer_;
};

}  // namespace lightsweep
