// Which arms of a group are worth their time: the front of time against error, and how sure the others are beaten.
// Pure functions of samples.
#pragma once

#include "bench/report/time_error.h"

#include <optional>
#include <string_view>
#include <vector>

namespace lightsweep {

enum class FrontState {
    front,      ///< by the estimates no other arm is as good in both time and error and better in one
    perhaps,    ///< beaten by the estimates, but by no single arm surely
    dominated,  ///< some arm is surely no worse in both and surely better in one
};

/// The word in reports: "front", ...
std::string_view word(FrontState state);

/// Of each point in turn. Errors of one picture are exact, so only times need a verdict: an arm surely beats another
/// when it is `faster` and its error no larger, or at least the `same` and its error smaller. Times are judged by the
/// paired ratio against `floor`, on the interval of level_for_each() for all n (n - 1) / 2 pairs, so that all states
/// hold together with kIntervalLevel. Without a floor nobody is surely beaten. `points`: of one group.
std::vector<FrontState> front_states(const std::vector<TimeErrorPoint>& points, std::optional<double> floor);

}  // namespace lightsweep
