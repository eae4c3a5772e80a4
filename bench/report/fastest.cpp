#include "bench/report/fastest.h"

#include "bench/report/pairs.h"

#include "bench/stats/quantile.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace lightsweep {
namespace {

struct Winner {
    CellParams arm;
    std::vector<CellParams> rivals;
};

struct Contest {
    CellParams view;
    std::set<std::string> arms;  // names
    std::map<int, Winner> winner_at;
};

double median_wall_ns(const CellResult& cell) {
    const std::vector<double> wall_ns(cell.samples.wall_ns.begin(), cell.samples.wall_ns.end());
    return median(wall_ns);
}

Winner winner_of(const std::vector<const CellResult*>& arms, std::optional<double> floor) {
    const CellResult* fastest = *std::ranges::min_element(arms, {}, [](const auto* a) { return median_wall_ns(*a); });
    Winner winner{.arm = without_lights(fastest->params), .rivals = {}};
    const double level =
        arms.size() < 2 ? kIntervalLevel : level_for_each(kIntervalLevel, arms.size() * (arms.size() - 1) / 2);
    for (const CellResult* other : arms) {
        if (other == fastest) continue;
        const auto ratio = time_ratio(*fastest, *other, level);
        if (ratio && floor && verdict(ratio->ratio, *floor) == Verdict::faster) continue;
        winner.rivals.push_back(without_lights(other->params));
    }
    return winner;
}

bool same_settings(const CellParams& a, const CellParams& b) {
    return a.hdr == b.hdr && a.guards == b.guards && a.sums == b.sums;
}

// The contests that a group's arms stand in, sampled or not: one for each HDR format, guards, sums and layout.
std::vector<CellParams> views_of(const GroupResult& group) {
    std::vector<CellParams> views;
    for (const bool with_layout : {true, false}) {
        for (const auto& cell : group.cells) {
            if (!cell.params.lights || cell.params.layout.empty() == with_layout) continue;
            if (cell.params.skip != contested_skip(group)) continue;
            CellParams view = without_lights(cell.params);
            view.path.clear();
            view.light_lists.clear();
            // Arms without a layout stand in every contest of their settings; in one of their own only if there is
            // none.
            const auto same = [&](const CellParams& v) { return with_layout ? v == view : same_settings(v, view); };
            if (std::ranges::none_of(views, same)) views.push_back(view);
        }
    }
    return views;
}

std::vector<FastestRange> ranges_of(const std::map<int, Winner>& winner_at) {
    std::vector<FastestRange> ranges;
    for (const auto& [lights, winner] : winner_at) {
        if (ranges.empty() || ranges.back().arm != winner.arm) {
            ranges.push_back(
                {.arm = winner.arm, .from_lights = lights, .to_lights = lights, .surely = true, .rivals = {}});
        }
        FastestRange& range = ranges.back();
        range.to_lights = lights;
        range.surely = range.surely && winner.rivals.empty();
        for (const auto& rival : winner.rivals) {
            if (std::ranges::find(range.rivals, rival) == range.rivals.end()) range.rivals.push_back(rival);
        }
    }
    return ranges;
}

}  // namespace

CellParams without_lights(CellParams arm) {
    arm.lights.reset();
    return arm;
}

bool same_kind(const CellParams& a, const CellParams& b) {
    return same_settings(a, b) && (a.layout == b.layout || a.layout.empty() || b.layout.empty());
}

std::vector<FastestOverLights> find_fastest(const std::vector<GroupResult>& groups, std::optional<double> run_floor) {
    std::vector<Contest> contests;
    for (const auto& group : groups) {
        const auto floor = floor_of(group, run_floor);
        for (const auto& view : views_of(group)) {
            std::vector<const CellResult*> arms;
            std::ranges::copy_if(competitors(group), std::back_inserter(arms),
                                 [&](const CellResult* cell) { return same_kind(cell->params, view); });
            if (arms.empty()) continue;
            auto contest = std::ranges::find(contests, view, &Contest::view);
            if (contest == contests.end()) {
                contest = contests.insert(contests.end(), {.view = view, .arms = {}, .winner_at = {}});
            }
            for (const CellResult* arm : arms) contest->arms.insert(without_lights(arm->params).name());
            contest->winner_at.try_emplace(*arms.front()->params.lights, winner_of(arms, floor));
        }
    }
    std::vector<FastestOverLights> result;
    for (const auto& contest : contests) {
        if (contest.arms.size() < 2 || contest.winner_at.size() < 2) continue;
        result.push_back({.view = contest.view, .ranges = ranges_of(contest.winner_at)});
    }
    return result;
}

}  // namespace lightsweep
