// A stress case: one way in which renderers break, turned up until this one does. To add one: write
// s<number>_<name>.cpp beside this, and put its row into cases.cpp. A case draws and computes through the Workbench; it
// prints nothing.
#pragma once

#include "bench/stress/arm.h"
#include "bench/stress/workbench.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

/// What is turned up, from where it must be right to where nothing may be.
struct StressParameter {
    std::string_view name;  ///< "distance from the origin"
    std::string_view unit;  ///< "units"; empty for a pure number
    double easy = 1.0;
    double hard = 1.0;   ///< above or below `easy`; both above 0: steps are factors
    int steps = 9;       ///< points of the first look, both ends among them; at least 2
    bool whole = false;  ///< integers alone
};

/// What a case found at one value of its parameter.
struct StressMeasurement {
    double error = 0.0;                ///< in StressCase::unit, >= 0
    std::optional<double> law = {};    ///< the error that theory predicts here
    std::optional<double> bound = {};  ///< in place of StressCase::bound
    int64_t non_finite = 0;            ///< values that are NaN or Inf although all input is finite: never right
    std::string where = {};            ///< what was worst: a pixel, a value, a format; for the reason
    /// Set where the format cannot hold what is asked and what came out is the nearest that it can: the number that
    /// tells ("an unsigned format holds nothing below 0"). Then an error above the bound is a limit.
    std::string limit = {};
};

/// Tries one arm; holds what it draws with. Called with the parameter, in any order; with 0 in a case without one.
/// The same parameter gives the same measurement.
using StressTrial = std::function<StressMeasurement(double parameter)>;

struct StressCase {
    std::string_view id;        ///< "S16", as in the table of docs/stability.md
    std::string_view summary;   ///< one line: what is done
    std::string_view measures;  ///< what the error is, of what
    std::string_view unit;      ///< of the error: "rel", "deg", "px", "step", "ulp", "count"
    double bound = 0.0;
    std::string_view bound_source;  ///< where the bound comes from
    std::string_view failure;       ///< what one sees where this goes wrong
    std::optional<StressParameter> parameter = {};
    /// Where a law is given, it must hold: measured over predicted within [1 / law_factor, law_factor] at every point
    /// whose law is above law_floor. 0: the law only tells limits from failures.
    double law_factor = 0.0;
    double law_floor = 0.0;
    std::vector<ArmBlock> (*arms)() = nullptr;
    /// Throws InputError or EnvironmentError where the device or the layout refuses the arm: it is then left out, with
    /// the reason.
    StressTrial (*begin)(Workbench& bench, const StressArm& arm) = nullptr;
};

}  // namespace lightsweep
