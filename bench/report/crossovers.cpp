#include "bench/report/crossovers.h"

#include "bench/report/pairs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace lightsweep {
namespace {

struct Series {
    CellParams a;
    CellParams b;
    std::map<int, Interval> ratio_at;  // light count -> a over b
};

// `deferred_tiled (oct32, cpu)`, as a sentence can say it.
std::string words(const CellParams& arm) {
    std::vector<std::string> details = switched(arm);
    if (!arm.light_lists.empty() && arm.light_lists != kAutoLightLists)
        details.insert(details.begin(), arm.light_lists);
    if (!arm.layout.empty()) details.insert(details.begin(), arm.layout);
    return details.empty() ? arm.path : fmt::format("{} ({})", arm.path, fmt::join(details, ", "));
}

bool is_baseline(const CellParams& arm) { return arm.path == kBaselinePath; }

// The series of two arms, made when it is not there yet. The baseline stands last, else the arm that was met first.
Series& series_of(std::vector<Series>& all, const CellResult& earlier, const CellResult& later) {
    CellParams a = without_lights(later.params), b = without_lights(earlier.params);
    if (is_baseline(a) && !is_baseline(b)) std::swap(a, b);
    const auto found =
        std::ranges::find_if(all, [&](const Series& s) { return (s.a == a && s.b == b) || (s.a == b && s.b == a); });
    if (found != all.end()) return *found;
    return all.emplace_back(Series{.a = std::move(a), .b = std::move(b), .ratio_at = {}});
}

std::vector<Series> all_series(const std::vector<GroupResult>& groups) {
    std::vector<Series> all;
    for (const auto& group : groups) {
        const auto arms = competitors(group);
        for (size_t i = 0; i < arms.size(); ++i) {
            const CellResult& earlier = *arms[i];
            if (!earlier.params.lights) continue;
            for (size_t j = i + 1; j < arms.size(); ++j) {
                const CellResult& later = *arms[j];
                if (!same_kind(earlier.params, later.params)) continue;
                Series& series = series_of(all, earlier, later);
                const bool turned = series.a == without_lights(earlier.params);
                const auto ratio = time_ratio(turned ? earlier : later, turned ? later : earlier, kIntervalLevel);
                if (ratio) series.ratio_at.try_emplace(*earlier.params.lights, ratio->ratio);
            }
        }
    }
    return all;
}

bool neighbours(const std::vector<FastestOverLights>& fastest, const CellParams& a, const CellParams& b) {
    return std::ranges::any_of(fastest, [&](const FastestOverLights& contest) {
        const auto meet = [&](const FastestRange& before, const FastestRange& after) {
            return (before.arm == a && after.arm == b) || (before.arm == b && after.arm == a);
        };
        return std::ranges::adjacent_find(contest.ranges, meet) != contest.ranges.end();
    });
}

// Whether each is surely the faster one somewhere.
bool both_win(const Series& series) {
    const auto wins = [&](auto is_faster) {
        return std::ranges::any_of(series.ratio_at, [&](const auto& at) { return is_faster(at.second); });
    };
    return wins([](const Interval& ratio) { return ratio.high && *ratio.high < 1.0; }) &&
           wins([](const Interval& ratio) { return ratio.low && *ratio.low > 1.0; });
}

bool same_view(const CellParams& a, const CellParams& b) {
    return a.scene == b.scene && a.width == b.width && a.height == b.height && a.overlap == b.overlap;
}

// Views in the order met, and in each those against the baseline first.
void put_in_order(std::vector<ArmCrossover>& crossovers) {
    for (auto begin = crossovers.begin(); begin != crossovers.end();) {
        const CellParams view = begin->a;
        const auto end =
            std::stable_partition(begin, crossovers.end(), [&](const ArmCrossover& c) { return same_view(c.a, view); });
        std::stable_partition(begin, end, [](const ArmCrossover& c) { return is_baseline(c.b); });
        begin = end;
    }
}

}  // namespace

std::vector<ArmCrossover> find_crossovers(const std::vector<GroupResult>& groups,
                                          const std::vector<FastestOverLights>& fastest) {
    std::vector<ArmCrossover> result;
    for (const auto& series : all_series(groups)) {
        if (series.ratio_at.size() < 2) continue;
        std::vector<double> lights;
        std::vector<Interval> ratios;
        for (const auto& [count, ratio] : series.ratio_at) {
            lights.push_back(count);
            ratios.push_back(ratio);
        }
        ArmCrossover found{.a = series.a,
                           .b = series.b,
                           .on_envelope = neighbours(fastest, series.a, series.b),
                           .crossover = find_crossover(lights, ratios, words(series.a), words(series.b))};
        const bool worth_saying = is_baseline(series.b) || found.on_envelope || found.crossover.lights;
        if (worth_saying || both_win(series)) result.push_back(std::move(found));
    }
    put_in_order(result);
    return result;
}

}  // namespace lightsweep
