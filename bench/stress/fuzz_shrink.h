// The smallest document that still does what a large one does. Knows JSON, and nothing of scenes.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>

namespace lightsweep {

/// Whether a document still shows what is looked for. One that is malformed does not.
using StillShows = std::function<bool(const nlohmann::ordered_json& document)>;

/// Takes away elements of lists (halves first, then fewer), members of objects, and digits of numbers, as long as
/// `still_shows` holds, until nothing more can go or `may_go_on` says no. `document` itself shows it.
nlohmann::ordered_json shrink(nlohmann::ordered_json document, const StillShows& still_shows,
                              const std::function<bool()>& may_go_on);

}  // namespace lightsweep
