#include "bench/stress/judge.h"

#include "renderer/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr int kQuickSteps = 3;

class Judge {
  public:
    Judge(const StressCase& stress_case, StressTrial trial) : case_(stress_case), trial_(std::move(trial)) {}

    const StressPoint& at(double parameter) {
        StressPoint point{.parameter = parameter, .found = trial_(parameter)};
        point.bound = point.found.bound.value_or(case_.bound);
        point.verdict = verdict(point);
        curve_.push_back(std::move(point));
        return curve_.back();
    }

    // Narrows (right, broken] to the width that a breakdown is told with.
    double narrow(double right, double broken) {
        while (std::abs(std::log(broken / right)) > std::log1p(kBreakdownWidth)) {
            double middle = std::sqrt(right * broken);
            if (case_.parameter->whole) {
                middle = std::round(middle);
                if (middle == right || middle == broken) break;
            }
            (at(middle).verdict == StressVerdict::pass ? right : broken) = middle;
        }
        return broken;
    }

    std::vector<StressPoint> take_curve() { return std::move(curve_); }

  private:
    StressVerdict verdict(const StressPoint& point) const {
        const StressMeasurement& found = point.found;
        if (found.non_finite > 0) return StressVerdict::fail;
        if (breaks_law(found)) return StressVerdict::fail;
        if (found.error <= point.bound) return StressVerdict::pass;
        const bool as_predicted = found.law && found.error <= kLawSlack * *found.law;
        return as_predicted || !found.limit.empty() ? StressVerdict::limit : StressVerdict::fail;
    }

    bool breaks_law(const StressMeasurement& found) const {
        if (case_.law_factor == 0.0 || !found.law || !(*found.law > case_.law_floor)) return false;
        const double ratio = found.error / *found.law;
        return !(ratio <= case_.law_factor && ratio >= 1.0 / case_.law_factor);
    }

    const StressCase& case_;
    StressTrial trial_;
    std::vector<StressPoint> curve_;
};

// Factors from easy to hard.
std::vector<double> steps(const StressParameter& parameter, bool quick) {
    const int count = quick ? std::min(parameter.steps, kQuickSteps) : parameter.steps;
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
        double value = parameter.easy * std::pow(parameter.hard / parameter.easy, i / (count - 1.0));
        if (i == count - 1) value = parameter.hard;
        if (parameter.whole) value = std::round(value);
        if (values.empty() || values.back() != value) values.push_back(value);
    }
    return values;
}

// Tries from easy to hard. The first value beyond the bound, narrowed unless `quick`.
std::optional<double> look_for_breakdown(const StressCase& stress_case, bool quick, Judge& trials) {
    if (!stress_case.parameter) {
        trials.at(0.0);
        return {};
    }
    std::optional<double> breakdown;
    double right = 0.0;
    for (const double value : steps(*stress_case.parameter, quick)) {
        const bool passes = trials.at(value).verdict == StressVerdict::pass;
        if (!passes && !breakdown) breakdown = quick || right == 0.0 ? value : trials.narrow(right, value);
        right = value;
    }
    return breakdown;
}

double excess(const StressPoint& point) {
    if (point.found.non_finite > 0 || !std::isfinite(point.found.error)) return INFINITY;
    return point.bound > 0.0 ? point.found.error / point.bound : point.found.error;
}

std::string reason_of(const StressCase& stress_case, const StressPoint& point) {
    const StressMeasurement& found = point.found;
    std::string text;
    if (found.non_finite > 0) {
        text = fmt::format("{} values are not finite", found.non_finite);
    } else {
        text = fmt::format("{:.3g} {}, bound {:.3g}", found.error, stress_case.unit, point.bound);
    }
    if (found.law) text += fmt::format(", predicted {:.3g}", *found.law);
    if (!found.limit.empty()) text += "; " + found.limit;
    if (!found.where.empty()) text += "; " + found.where;
    return text;
}

void decide(StressResult& result) {
    const auto broken =
        std::ranges::find_if(result.curve, [](const auto& p) { return p.verdict != StressVerdict::pass; });
    const auto failed = std::ranges::find(result.curve, StressVerdict::fail, &StressPoint::verdict);
    // A failure anywhere outweighs the limits before it.
    const auto told = failed != result.curve.end() ? failed : broken;
    if (told == result.curve.end()) {
        result.worst = *std::ranges::max_element(result.curve, {}, excess);
        return;
    }
    result.worst = *told;
    result.verdict = told->verdict;
    result.reason = reason_of(*result.of, *told);
}

}  // namespace

std::string_view word(StressVerdict verdict) {
    switch (verdict) {
        case StressVerdict::pass:
            return "pass";
        case StressVerdict::fail:
            return "fail";
        case StressVerdict::limit:
            return "limit";
        case StressVerdict::skipped:
            break;
    }
    return "skipped";
}

StressResult judge(const StressCase& stress_case, const StressArm& arm, Workbench& bench, bool quick) {
    return judge(
        stress_case, arm, [&] { return stress_case.begin(bench, arm); }, quick);
}

StressResult judge(const StressCase& stress_case, const StressArm& arm, const std::function<StressTrial()>& begin,
                   bool quick) {
    StressResult result{.of = &stress_case, .arm = arm};
    const auto end = [&](StressVerdict verdict, const std::exception& error) {
        result.verdict = verdict;
        result.reason = error.what();
    };
    // Only before anything was tried may an arm be refused.
    StressTrial trial;
    try {
        trial = begin();
    } catch (const InputError& error) {
        end(StressVerdict::skipped, error);
    } catch (const EnvironmentError& error) {
        end(StressVerdict::skipped, error);
    } catch (const std::exception& error) {
        end(StressVerdict::fail, error);
    }
    if (!trial) return result;

    Judge trials(stress_case, std::move(trial));
    try {
        result.breakdown = look_for_breakdown(stress_case, quick, trials);
    } catch (const std::exception& error) {
        end(StressVerdict::fail, error);
    }
    result.curve = trials.take_curve();
    if (stress_case.parameter) {
        const bool rising = stress_case.parameter->hard > stress_case.parameter->easy;
        std::ranges::stable_sort(result.curve, [&](const StressPoint& a, const StressPoint& b) {
            return rising ? a.parameter < b.parameter : a.parameter > b.parameter;
        });
    }
    if (result.verdict != StressVerdict::fail) decide(result);
    return result;
}

}  // namespace lightsweep
