// Plain structs to strict JSON and back. A struct names its fields once, in a function visit_fields(struct, visit), and
// both directions follow from it. Knows no struct of its own.
#pragma once

#include "renderer/base/error.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lightsweep::codec {

using Json = nlohmann::ordered_json;

template <typename T>
struct Codec;

template <typename T>
Json encode(const T& value) {
    return Codec<T>::encode(value);
}

/// `where`: file and JSON pointer, for messages.
template <typename T>
T decode(const Json& json, const std::string& where) {
    return Codec<T>::decode(json, where);
}

[[noreturn]] inline void refuse(const Json& json, const std::string& where, const char* expected) {
    throw InputError(where, std::string(expected) + " was expected, not " + json.type_name());
}

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

/// The member `key` of an object. What may be null may be missing: earlier files of the same version have fewer keys.
template <typename T>
T member(const Json& json, const std::string& key, const std::string& where) {
    if (!json.is_object()) refuse(json, where, "an object");
    const auto found = json.find(key);
    if (found != json.end()) return decode<T>(*found, where + "/" + key);
    if constexpr (kIsOptional<T>) return std::nullopt;
    throw InputError(where, "the key '" + key + "' is missing");
}

/// Empty text stands for nothing.
inline Json or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// A struct with a visit_fields().
template <typename T>
struct Codec {
    static Json encode(const T& value) {
        Json json = Json::object();
        visit_fields(value, [&](const char* key, const auto& field) { json[key] = codec::encode(field); });
        return json;
    }
    static T decode(const Json& json, const std::string& where) {
        T value;
        visit_fields(value, [&](const char* key, auto& field) {
            field = member<std::remove_cvref_t<decltype(field)>>(json, key, where);
        });
        return value;
    }
};

template <>
struct Codec<Json> {
    static Json encode(const Json& value) { return value; }
    static Json decode(const Json& json, const std::string&) { return json; }
};

template <>
struct Codec<bool> {
    static Json encode(bool value) { return value; }
    static bool decode(const Json& json, const std::string& where) {
        if (!json.is_boolean()) refuse(json, where, "true or false");
        return json.get<bool>();
    }
};

template <std::integral T>
struct Codec<T> {
    static Json encode(T value) { return value; }
    static T decode(const Json& json, const std::string& where) {
        if (!json.is_number_integer()) refuse(json, where, "a whole number");
        const auto value = json.get<int64_t>();
        if (!std::in_range<T>(value)) throw InputError(where, "the number " + json.dump() + " is out of range");
        return static_cast<T>(value);
    }
};

/// JSON knows no NaN and no infinity: both become null, and null becomes NaN.
template <>
struct Codec<double> {
    static Json encode(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
    static double decode(const Json& json, const std::string& where) {
        if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
        if (!json.is_number()) refuse(json, where, "a number");
        return json.get<double>();
    }
};

template <>
struct Codec<std::string> {
    static Json encode(const std::string& value) { return value; }
    static std::string decode(const Json& json, const std::string& where) {
        if (!json.is_string()) refuse(json, where, "a string");
        return json.get<std::string>();
    }
};

template <typename T>
struct Codec<std::optional<T>> {
    static Json encode(const std::optional<T>& value) { return value ? codec::encode(*value) : Json(nullptr); }
    static std::optional<T> decode(const Json& json, const std::string& where) {
        if (json.is_null()) return std::nullopt;
        return codec::decode<T>(json, where);
    }
};

template <typename T>
struct Codec<std::vector<T>> {
    static Json encode(const std::vector<T>& values) {
        Json json = Json::array();
        for (const auto& value : values) json.push_back(codec::encode<T>(value));
        return json;
    }
    static std::vector<T> decode(const Json& json, const std::string& where) {
        if (!json.is_array()) refuse(json, where, "a list");
        std::vector<T> values;
        values.reserve(json.size());
        for (size_t i = 0; i < json.size(); ++i) {
            values.push_back(codec::decode<T>(json[i], where + "/" + std::to_string(i)));
        }
        return values;
    }
};

template <typename T>
struct Codec<std::map<std::string, T>> {
    static Json encode(const std::map<std::string, T>& values) {
        Json json = Json::object();
        for (const auto& [key, value] : values) json[key] = codec::encode<T>(value);
        return json;
    }
    static std::map<std::string, T> decode(const Json& json, const std::string& where) {
        if (!json.is_object()) refuse(json, where, "an object");
        std::map<std::string, T> values;
        for (const auto& [key, value] : json.items()) values[key] = codec::decode<T>(value, where + "/" + key);
        return values;
    }
};

/// Named things in an order that matters: an object whose keys keep their order.
template <typename T>
struct Codec<std::vector<std::pair<std::string, T>>> {
    static Json encode(const std::vector<std::pair<std::string, T>>& values) {
        Json json = Json::object();
        for (const auto& [key, value] : values) json[key] = codec::encode<T>(value);
        return json;
    }
    static std::vector<std::pair<std::string, T>> decode(const Json& json, const std::string& where) {
        if (!json.is_object()) refuse(json, where, "an object");
        std::vector<std::pair<std::string, T>> values;
        for (const auto& [key, value] : json.items()) {
            values.emplace_back(key, codec::decode<T>(value, where + "/" + key));
        }
        return values;
    }
};

}  // namespace lightsweep::codec
