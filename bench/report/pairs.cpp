#include "bench/report/pairs.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <utility>

namespace lightsweep {
namespace {

using Arms = std::pair<const CellResult*, const CellResult*>;

std::vector<Arms> arms_to_compare(const GroupResult& group) {
    std::vector<const CellResult*> arms;
    for (const auto& cell : group.cells) {
        if (cell.measured()) arms.push_back(&cell);
    }
    std::vector<Arms> pairs;
    for (size_t i = 1; i < arms.size(); ++i) pairs.emplace_back(arms[i], arms[0]);
    for (const CellResult* arm : arms) {
        if (arm->params.layout.empty()) continue;
        const auto twin = std::ranges::find_if(arms, [&](const CellResult* other) {
            return other->params.path == kBaselinePath && other->params.hdr == arm->params.hdr &&
                   other->params.skip == arm->params.skip && other->params.guards == arm->params.guards &&
                   other->params.sums == arm->params.sums;
        });
        if (twin == arms.end() || std::ranges::find(pairs, Arms{arm, *twin}) != pairs.end()) continue;
        // The group's first arm may have a layout: then the forward arm stands against it already.
        if (std::ranges::find(pairs, Arms{*twin, arm}) == pairs.end()) pairs.emplace_back(arm, *twin);
    }
    return pairs;
}

}  // namespace

const std::string& contested_skip(const GroupResult& group) {
    CHECK(!group.cells.empty());
    const auto found =
        std::ranges::find_if(group.cells, [](const CellResult& cell) { return cell.params.skip == kSkipEverything; });
    return (found != group.cells.end() ? *found : group.cells.front()).params.skip;
}

std::vector<const CellResult*> competitors(const GroupResult& group) {
    std::vector<const CellResult*> result;
    for (const auto& cell : group.cells) {
        const bool own_arm = cell.params.path != kAutoPath && cell.params.skip == contested_skip(group);
        if (cell.measured() && own_arm) result.push_back(&cell);
    }
    return result;
}

PairedFrames pair_by_round(const std::vector<int64_t>& round_a, const std::vector<int64_t>& wall_ns_a,
                           const std::vector<int64_t>& round_b, const std::vector<int64_t>& wall_ns_b) {
    CHECK_THAT(round_a.size() == wall_ns_a.size(), "{} rounds, {} samples", round_a.size(), wall_ns_a.size());
    CHECK_THAT(round_b.size() == wall_ns_b.size(), "{} rounds, {} samples", round_b.size(), wall_ns_b.size());
    PairedFrames paired;
    for (size_t i = 0, j = 0; i < round_a.size() && j < round_b.size();) {
        if (round_a[i] == round_b[j]) {
            paired.a_ns.push_back(static_cast<double>(wall_ns_a[i++]));
            paired.b_ns.push_back(static_cast<double>(wall_ns_b[j++]));
        } else {
            ++(round_a[i] < round_b[j] ? i : j);
        }
    }
    return paired;
}

std::optional<PairedRatio> ratio_by_round(const std::vector<int64_t>& round_a, const std::vector<int64_t>& wall_ns_a,
                                          const std::vector<int64_t>& round_b, const std::vector<int64_t>& wall_ns_b,
                                          double level) {
    const auto [a_ns, b_ns] = pair_by_round(round_a, wall_ns_a, round_b, wall_ns_b);
    return ratio_of_pairs(a_ns, b_ns, level);
}

std::optional<PairedRatio> time_ratio(const CellResult& a, const CellResult& b, double level) {
    return ratio_by_round(a.samples.round, a.samples.wall_ns, b.samples.round, b.samples.wall_ns, level);
}

bool share_samples(const CellResult& a, const CellResult& b) {
    const std::string& of_a = a.shared_with.value_or(a.id);
    return of_a == b.shared_with.value_or(b.id);
}

std::optional<PairedRatio> noise_ratio(const GroupResult& group) {
    if (!group.noise) return {};
    const auto arm = std::ranges::find(group.cells, group.noise->arm, &CellResult::name);
    if (arm == group.cells.end() || !arm->measured()) return {};
    return ratio_by_round(group.noise->round, group.noise->wall_ns, arm->samples.round, arm->samples.wall_ns,
                          kIntervalLevel);
}

std::optional<double> noise_floor(const PairedRatio& twin) {
    if (!twin.ratio.low || !twin.ratio.high) return {};
    return std::max(*twin.ratio.high, 1.0 / *twin.ratio.low) - 1.0;
}

std::optional<double> noise_floor(const std::vector<GroupResult>& groups) {
    std::optional<double> floor;
    for (const auto& group : groups) {
        const auto twin = noise_ratio(group);
        const auto of_group = twin ? noise_floor(*twin) : std::nullopt;
        if (of_group) floor = std::max(floor.value_or(0.0), *of_group);
    }
    return floor;
}

std::optional<double> floor_of(const GroupResult& group, std::optional<double> run_floor) {
    const auto twin = noise_ratio(group);
    const auto own_floor = twin ? noise_floor(*twin) : std::nullopt;
    return own_floor ? own_floor : run_floor;
}

std::vector<ArmPair> compare_arms(const GroupResult& group, std::optional<double> run_floor) {
    const auto floor = floor_of(group, run_floor);
    auto pairs = arms_to_compare(group);
    std::erase_if(pairs, [](const auto& pair) { return share_samples(*pair.first, *pair.second); });
    std::vector<ArmPair> result;
    for (const auto& [a, b] : pairs) {
        const auto ratio = time_ratio(*a, *b, kIntervalLevel);
        if (!ratio) continue;
        ArmPair pair{.a = a, .b = b, .ratio = *ratio, .verdict = Verdict::ambiguous, .floor = floor};
        if (floor) {
            pair.verdict = verdict(time_ratio(*a, *b, level_for_each(kIntervalLevel, pairs.size()))->ratio, *floor);
        }
        result.push_back(pair);
    }
    return result;
}

}  // namespace lightsweep
