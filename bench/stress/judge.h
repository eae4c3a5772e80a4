// From measurements to a verdict: right everywhere, wrong, or beyond what the format can hold; and from which value of
// the parameter on.
#pragma once

#include "bench/stress/case.h"

#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

enum class StressVerdict : uint8_t { pass, fail, limit, skipped };
std::string_view word(StressVerdict verdict);

struct StressPoint {
    double parameter = 0.0;
    StressMeasurement found = {};
    double bound = 0.0;
    StressVerdict verdict = StressVerdict::pass;  ///< of this point alone; never skipped
};

struct StressResult {
    const StressCase* of = nullptr;
    StressArm arm;
    StressVerdict verdict = StressVerdict::pass;
    /// The smallest step towards `hard` at which the error passes the bound, to 5 % of the parameter (exact for whole
    /// numbers below 20); nothing where it never does, and in cases without parameter.
    std::optional<double> breakdown = {};
    /// The point that the verdict is about: where it broke first; else the one with the largest error over its bound.
    StressPoint worst = {};
    std::string reason = {};              ///< of what is not a pass: one line
    std::vector<StressPoint> curve = {};  ///< all points tried, by parameter from easy to hard
};

/// A measured error counts as the law's when it is at most this much larger.
inline constexpr double kLawSlack = 2.0;
/// The relative width to which bisection narrows the breakdown.
inline constexpr double kBreakdownWidth = 0.05;

/// Tries one arm. `quick`: no bisection, and three points at most. Never throws for what the arm itself does.
StressResult judge(const StressCase& stress_case, const StressArm& arm, Workbench& bench, bool quick);
/// The same of a trial that `begin` makes in place of the case's own.
StressResult judge(const StressCase& stress_case, const StressArm& arm, const std::function<StressTrial()>& begin,
                   bool quick);

}  // namespace lightsweep
