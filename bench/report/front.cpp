#include "bench/report/front.h"

#include "bench/report/pairs.h"

#include "bench/stats/pareto.h"

#include <algorithm>

namespace lightsweep {
namespace {

bool surely_beats(const TimeErrorPoint& a, const TimeErrorPoint& b, double floor, double level) {
    if (a.cell == b.cell || a.error.estimate > b.error.estimate) return false;
    const auto ratio = time_ratio(*a.cell, *b.cell, level);
    if (!ratio) return false;
    const Verdict judged = verdict(ratio->ratio, floor);
    return judged == Verdict::faster || (judged == Verdict::same && a.error.estimate < b.error.estimate);
}

}  // namespace

std::string_view word(FrontState state) {
    constexpr std::string_view kWords[] = {"front", "perhaps", "dominated"};
    return kWords[static_cast<size_t>(state)];
}

std::vector<FrontState> front_states(const std::vector<TimeErrorPoint>& points, std::optional<double> floor) {
    std::vector<FrontState> states(points.size(), FrontState::perhaps);
    std::vector<TimeAndError> estimates;
    for (const auto& point : points) estimates.push_back({point.time_ns.estimate, point.error.estimate});
    for (const size_t index : pareto_front(estimates)) states[index] = FrontState::front;
    if (!floor || points.size() < 2) return states;

    const double level = level_for_each(kIntervalLevel, points.size() * (points.size() - 1) / 2);
    std::vector<const TimeErrorPoint*> by_time;  // who beats an arm is likely among the fastest
    for (const auto& point : points) by_time.push_back(&point);
    std::ranges::stable_sort(by_time, {}, [](const auto* point) { return point->time_ns.estimate; });
    for (size_t i = 0; i < points.size(); ++i) {
        if (states[i] == FrontState::front) continue;
        const auto beats = [&](const auto* other) { return surely_beats(*other, points[i], *floor, level); };
        if (std::ranges::any_of(by_time, beats)) states[i] = FrontState::dominated;
    }
    return states;
}

}  // namespace lightsweep
