// What the tests of encodings share: variants by their names, and what comes back of them through the GPU.
#pragma once

#include "bench/encodings/field_kind.h"
#include "bench/encodings/round_trip.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace lightsweep {

inline constexpr int kSide = 512;  // 262,144 values: a mean's standard error is some 0.1 %

inline const Variant& variant(const std::string& field, const std::string& name) {
    static const auto all = shipped_variants();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Variant& v) { return v.field == field && v.name == name; });
    if (found == all.end()) throw std::runtime_error("no variant " + field + " " + name);
    return *found;
}

struct Sent {
    std::vector<glm::vec4> values, back;
};

inline const Sent& sent(const std::string& field, const std::string& name) {
    static std::map<std::string, Sent> cache;
    const auto [entry, is_new] = cache.try_emplace(field + " " + name);
    if (is_new) {
        const Variant& v = variant(field, name);
        entry->second.values = make_samples(v, kSide, kSide);
        entry->second.back = round_trip(v, entry->second.values, kSide, kSide);
    }
    return entry->second;
}

inline ErrorSummary errors(const std::string& field, const std::string& name) {
    const Sent& s = sent(field, name);
    return summarize_errors(field_kind(field), s.values, s.back);
}

inline double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// Sends these values, padded to a whole target, and gives what comes back of them.
inline std::vector<glm::dvec3> back_of(const Variant& v, std::vector<glm::vec4> values) {
    const size_t count = values.size();
    values.resize(64, values.front());
    const auto back = round_trip(v, values, 8, 8);
    return {back.begin(), back.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace lightsweep
