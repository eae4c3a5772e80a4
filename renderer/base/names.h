// Names that users type: the nearest valid one, and the one sentence that says what is allowed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

/// The candidate with the smallest edit distance to `word`, or empty when none is near (over half of its length).
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// `unknown path 'defered' (did you mean 'deferred'?); known: deferred, forward`
std::string unknown_name(std::string_view what, std::string_view word, std::span<const std::string> candidates);

/// Splits at `separator`; "a,,b" gives three parts, "" gives none.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace lightsweep
