#include "bench/measure/self_test.h"

#include "bench/measure/known_work.h"
#include "bench/stats/linear_fit.h"
#include "bench/stats/quantile.h"
#include "renderer/base/error.h"
#include "renderer/gl/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr int64_t kUnitNs = 1'500'000;  // long against a clock's and a glFinish's own cost (some tens of microseconds)
constexpr int kRepetitions = 9;
const std::vector<int64_t> kAmounts = {1, 2, 4};

double median_of(std::vector<double> values) { return median(values); }

int64_t median_ns(const std::vector<int64_t>& values) {
    return std::llround(median_of({values.begin(), values.end()}));
}

TimerCase judge_trial(const TimerTrial& trial) {
    TimerCase result{.kind = trial.kind,
                     .target_px = trial.target_px,
                     .framebuffers = trial.framebuffers,
                     .work = trial.amounts,
                     .measured_ns = {},
                     .yardstick_ns = {},
                     .ratio = {},
                     .linearity = {}};
    std::vector<double> amounts, times;
    for (size_t a = 0; a < trial.amounts.size(); ++a) {
        std::vector<double> ratios;
        for (size_t r = 0; r < trial.measured_ns[a].size(); ++r) {
            ratios.push_back(static_cast<double>(trial.measured_ns[a][r]) /
                             static_cast<double>(std::max<int64_t>(1, trial.yardstick_ns[a][r])));
        }
        result.measured_ns.push_back(median_ns(trial.measured_ns[a]));
        result.yardstick_ns.push_back(median_ns(trial.yardstick_ns[a]));
        const double ratio = median_of(ratios);
        // The worst amount speaks for the kind.
        if (!result.ratio || std::abs(std::log(std::max(ratio, 1e-9))) > std::abs(std::log(std::max(*result.ratio, 1e-9)))) {
            result.ratio = ratio;
        }
        amounts.push_back(static_cast<double>(trial.amounts[a]));
        times.push_back(static_cast<double>(result.measured_ns.back()));
    }
    if (const auto line = linear_fit(amounts, times)) result.linearity = line->r_squared;
    return result;
}

std::string complaint(const TimerCase& c) {
    if (c.ratio && (*c.ratio < kLowestRatio || *c.ratio > kHighestRatio)) {
        return fmt::format("{}: {:.4g} of the clock with glFinish", c.kind, *c.ratio);
    }
    if (!c.linearity || *c.linearity < kLowestLinearity) {
        return fmt::format("{}: not linear in the work (R^2 {:.3f})", c.kind, c.linearity.value_or(0.0));
    }
    return {};
}

}  // namespace

std::vector<TimerUnderTest> all_timers() {
    std::vector<TimerUnderTest> timers;
    for (const auto& method : timer_methods()) timers.push_back({method, make_frame_timer(method)});
    return timers;
}

TimerMethodReport judge_timer(const std::string& method, const std::vector<TimerTrial>& trials) {
    TimerMethodReport report{.method = method, .accepted = true, .why = {}, .overhead_ns = {}, .cases = {}};
    for (const auto& trial : trials) {
        report.cases.push_back(judge_trial(trial));
        const std::string wrong = complaint(report.cases.back());
        if (wrong.empty()) continue;
        report.why += (report.accepted ? "" : "; ") + wrong;
        report.accepted = false;
    }
    if (report.accepted) report.why = "agrees with the clock on every kind of work";
    return report;
}

TimerReport choose_timer(std::vector<TimerMethodReport> methods, const std::string& forced) {
    TimerReport report{.method = forced, .forced = !forced.empty(), .why = {}, .methods = std::move(methods)};
    if (report.forced) {
        report.why = "forced by the user";
        return report;
    }
    for (const auto& method : report.methods) {
        if (!method.accepted) continue;
        report.method = method.method;
        report.why = "the cheapest method that agrees with the clock with glFinish on every kind of work";
        return report;
    }
    std::string why;
    for (const auto& method : report.methods) why += fmt::format("; {}: {}", method.method, method.why);
    throw EnvironmentError("no trustworthy timer on this device (--timer METHOD overrides)" + why);
}

TimerReport run_timer_self_test(std::vector<TimerUnderTest> timers, const std::string& forced) {
    KnownWork work;
    work.calibrate(kUnitNs);
    const auto& kinds = work_kinds();
    std::vector<std::vector<TimerTrial>> trials(timers.size());
    std::vector<std::vector<double>> overheads(timers.size());
    for (size_t k = 0; k < kinds.size(); ++k) {
        for (auto& of_timer : trials) {
            of_timer.push_back({kinds[k].key, {kinds[k].width, kinds[k].height}, kinds[k].framebuffers, kAmounts,
                                std::vector<std::vector<int64_t>>(kAmounts.size()),
                                std::vector<std::vector<int64_t>>(kAmounts.size())});
        }
        for (size_t a = 0; a < kAmounts.size(); ++a) {
            const int amount = static_cast<int>(kAmounts[a]);
            for (int repetition = 0; repetition < kRepetitions; ++repetition) {
                const int64_t yardstick = work.clock_ns(k, amount);
                for (size_t t = 0; t < timers.size(); ++t) {
                    const int64_t start = now_ns();
                    work.issue(k, amount, *timers[t].timer);
                    gl::finish();
                    overheads[t].push_back(static_cast<double>(now_ns() - start - yardstick));
                    trials[t].back().yardstick_ns[a].push_back(yardstick);
                    trials[t].back().measured_ns[a].push_back(timers[t].timer->take().total_ns);
                }
            }
        }
    }
    std::vector<TimerMethodReport> methods;
    for (size_t t = 0; t < timers.size(); ++t) {
        methods.push_back(judge_timer(timers[t].method, trials[t]));
        methods.back().overhead_ns = std::llround(median_of(overheads[t]));
    }
    return choose_timer(std::move(methods), forced);
}

}  // namespace lightsweep
