#include "bench/stress/fuzz_shrink.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// Every place of a document of which `wanted` holds, outer ones first.
template <class Wanted>
void collect(const Json& value, const Pointer& at, const Wanted& wanted, std::vector<Pointer>& places) {
    if (wanted(value)) places.push_back(at);
    if (value.is_object()) {
        for (const auto& [key, member] : value.items()) collect(member, at / key, wanted, places);
    } else if (value.is_array()) {
        for (size_t i = 0; i < value.size(); ++i) collect(value[i], at / i, wanted, places);
    }
}

template <class Wanted>
std::vector<Pointer> places_of(const Json& document, const Wanted& wanted) {
    std::vector<Pointer> places;
    collect(document, Pointer(), wanted, places);
    return places;
}

class Shrinker {
  public:
    Shrinker(Json document, const StillShows& still_shows, const std::function<bool()>& may_go_on)
        : document_(std::move(document)), still_shows_(still_shows), may_go_on_(may_go_on) {}

    Json run() {
        do {
            changed_ = false;
            shorten_lists();
            drop_members();
            simplify_numbers();
        } while (changed_ && may_go_on_());
        return std::move(document_);
    }

  private:
    bool accept(Json smaller) {
        if (!may_go_on_() || !still_shows_(smaller)) return false;
        document_ = std::move(smaller);
        changed_ = true;
        return true;
    }

    void shorten_lists() {
        // Colours and positions are lists too, but none of their numbers can go.
        const auto lists = places_of(document_, [](const Json& v) {
            return v.is_array() && std::ranges::any_of(v, [](const Json& e) { return e.is_structured(); });
        });
        for (const Pointer& list : lists) {
            if (document_.contains(list)) shorten(list);
        }
    }

    void shorten(const Pointer& list) {
        for (size_t chunk = document_[list].size(); chunk > 0; chunk /= 2) {
            for (size_t begin = 0; begin < document_[list].size();) {
                Json smaller = document_;
                Json& elements = smaller[list];
                const auto first = elements.begin() + static_cast<std::ptrdiff_t>(begin);
                elements.erase(first, first + static_cast<std::ptrdiff_t>(std::min(chunk, elements.size() - begin)));
                if (!accept(std::move(smaller))) begin += chunk;
            }
        }
    }

    void drop_members() {
        const auto objects = places_of(document_, [](const Json& v) { return v.is_object(); });
        for (const Pointer& object : objects) {
            if (!document_.contains(object)) continue;
            std::vector<std::string> keys;
            for (const auto& [key, ignored] : document_[object].items()) keys.push_back(key);
            for (const std::string& key : keys) {
                Json smaller = document_;
                smaller[object].erase(key);
                accept(std::move(smaller));
            }
        }
    }

    // 0, 1, or one digit in place of many.
    void simplify_numbers() {
        const auto numbers = places_of(document_, [](const Json& v) { return v.is_number_float(); });
        for (const Pointer& number : numbers) {
            const auto value = document_[number].get<double>();
            for (const double simple : {0.0, 1.0, std::stod(fmt::format("{:.0e}", value))}) {
                if (simple == value) break;
                Json smaller = document_;
                smaller[number] = simple;
                if (accept(std::move(smaller))) break;
            }
        }
    }

    Json document_;
    const StillShows& still_shows_;
    const std::function<bool()>& may_go_on_;
    bool changed_ = false;
};

}  // namespace

nlohmann::ordered_json shrink(nlohmann::ordered_json document, const StillShows& still_shows,
                              const std::function<bool()>& may_go_on) {
    return Shrinker(std::move(document), still_shows, may_go_on).run();
}

}  // namespace lightsweep
