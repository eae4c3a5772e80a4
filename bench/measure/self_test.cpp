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

constexpr int kAttempts = 5;
constexpr int64_t kAttemptsNs = 15'000'000'000;  // no further attempt is begun after this
// Of the clock around a frame. Two clocks may disagree by their own resolution and drift.
constexpr double kImpossibleRatio = 1.05;
constexpr double kFewest = 0.02;  // the share of repetitions that may lie outside the band, on each side
const std::vector<int64_t> kAmounts = {1, 2, 4};

int64_t median_ns(const std::vector<int64_t>& ns) {
    return std::llround(median(std::vector<double>(ns.begin(), ns.end())));
}

// Measured over yardstick, of every repetition of every amount.
std::vector<double> shares(const TimerTrial& trial) {
    std::vector<double> result;
    for (size_t a = 0; a < trial.amounts.size(); ++a) {
        for (size_t r = 0; r < trial.measured_ns[a].size(); ++r) {
            result.push_back(static_cast<double>(trial.measured_ns[a][r]) /
                             static_cast<double>(std::max<int64_t>(trial.yardstick_ns[a][r], 1)));
        }
    }
    return result;
}

double linearity(const std::vector<int64_t>& amounts, const std::vector<int64_t>& ns) {
    const auto line =
        linear_fit(std::vector<double>(amounts.begin(), amounts.end()), std::vector<double>(ns.begin(), ns.end()));
    return line ? line->r_squared : 0.0;
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
    for (size_t a = 0; a < trial.amounts.size(); ++a) {
        result.measured_ns.push_back(median_ns(trial.measured_ns[a]));
        result.yardstick_ns.push_back(median_ns(trial.yardstick_ns[a]));
    }
    result.ratio = median(shares(trial));
    result.linearity = linearity(result.work, result.measured_ns);
    return result;
}

// A time that cannot be: the first one found, as text; empty when there is none.
std::string impossible_time(const TimerTrial& trial) {
    for (size_t a = 0; a < trial.amounts.size(); ++a) {
        for (size_t r = 0; r < trial.measured_ns[a].size(); ++r) {
            const int64_t measured = trial.measured_ns[a][r], clock = trial.yardstick_ns[a][r];
            if (measured < 0 || static_cast<double>(measured) > kImpossibleRatio * static_cast<double>(clock)) {
                return fmt::format("{}: said {} ns where the clock saw {} ns", trial.kind, measured, clock);
            }
        }
    }
    return {};
}

std::string complaint(const TimerTrial& trial, const TimerCase& c) {
    const auto of_clock = shares(trial);
    const double low = quantile(of_clock, kFewest), high = quantile(of_clock, 1.0 - kFewest);
    if (low < kLowestRatio || high > kHighestRatio) {
        return fmt::format("{}: {:.3g} of the clock with glFinish [{:.3g}, {:.3g}]", c.kind, *c.ratio, low, high);
    }
    // On a busy machine the work itself does not take a time that is linear in its amount; then no timer can say so.
    const double wanted = std::min(kLowestLinearity, linearity(c.work, c.yardstick_ns) - (1.0 - kLowestLinearity));
    if (*c.linearity < wanted) {
        return fmt::format("{}: not linear in the work (R^2 {:.3f})", c.kind, *c.linearity);
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
        std::string wrong = impossible_time(trial);
        if (wrong.empty()) wrong = complaint(trial, report.cases.back());
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
        report.why = "forced by the user, not tested";
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
    throw EnvironmentError(
        "no timer agrees with the clock on this device, or the machine is too busy to tell "
        "(--timer METHOD overrides)" +
        why);
}

namespace {

struct Trials {
    std::vector<std::vector<TimerTrial>> trials;  ///< [timer][kind]
    std::vector<std::vector<double>> overheads;   ///< [timer], ns
};

Trials no_trials(size_t timers) {
    Trials result{std::vector<std::vector<TimerTrial>>(timers), std::vector<std::vector<double>>(timers)};
    const std::vector<std::vector<int64_t>> none(kAmounts.size());
    for (auto& of_timer : result.trials) {
        for (const auto& kind : work_kinds()) {
            of_timer.push_back({kind.key, {kind.width, kind.height}, kind.framebuffers, kAmounts, none, none});
        }
    }
    return result;
}

// Every kind of work by every timer: adds as many to each trial.
void add_repetitions(int repetitions, KnownWork& work, std::vector<TimerUnderTest>& timers, Trials& result) {
    for (size_t k = 0; k < work_kinds().size(); ++k) {
        for (size_t a = 0; a < kAmounts.size(); ++a) {
            const int amount = static_cast<int>(kAmounts[a]);
            for (int repetition = 0; repetition < repetitions; ++repetition) {
                const int64_t untimed = work.clock_ns(k, amount);
                for (size_t t = 0; t < timers.size(); ++t) {
                    TimerTrial& trial = result.trials[t][k];
                    const int64_t start = now_ns();
                    work.issue(k, amount, *timers[t].timer);
                    gl::finish();
                    trial.yardstick_ns[a].push_back(now_ns() - start);
                    result.overheads[t].push_back(static_cast<double>(trial.yardstick_ns[a].back() - untimed));
                    trial.measured_ns[a].push_back(timers[t].timer->take().total_ns);
                }
            }
        }
    }
}

std::vector<TimerMethodReport> judge_timers(const std::vector<TimerUnderTest>& timers, const Trials& result) {
    std::vector<TimerMethodReport> methods;
    for (size_t t = 0; t < timers.size(); ++t) {
        methods.push_back(judge_timer(timers[t].method, result.trials[t]));
        methods.back().overhead_ns = std::max<int64_t>(0, std::llround(median(result.overheads[t])));
    }
    return methods;
}

bool any_accepted(const std::vector<TimerMethodReport>& methods) {
    return std::any_of(methods.begin(), methods.end(), [](const auto& method) { return method.accepted; });
}

}  // namespace

std::vector<TimerMethodReport> test_timers(std::vector<TimerUnderTest> timers, TimerEffort effort) {
    KnownWork work;
    work.calibrate(effort.unit_ns);
    Trials trials = no_trials(timers.size());
    std::vector<TimerMethodReport> methods;
    const int64_t start = now_ns();
    for (int attempt = 0; attempt < kAttempts && !any_accepted(methods) && now_ns() - start < kAttemptsNs; ++attempt) {
        add_repetitions(effort.repetitions, work, timers, trials);
        methods = judge_timers(timers, trials);
    }
    return methods;
}

}  // namespace lightsweep
