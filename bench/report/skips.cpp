#include "bench/report/skips.h"

#include "bench/report/json_codec.h"

#include "bench/stats/quantile.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace lightsweep {
namespace {

std::string path_drawn(const CellResult& cell) { return cell.auto_path ? cell.auto_path->path : cell.params.path; }

bool same_but_skips(const CellResult& a, const CellResult& b) {
    CellParams params = b.params;
    params.skip = a.params.skip;
    return a.params == params && path_drawn(a) == path_drawn(b);
}

// With one skip and without it, or with a whole set and with none. Nothing when `with` is not that of the two.
std::optional<SkipSaving> saving_of(const CellResult& with, const CellResult& without) {
    SkipSaving saving;
    saving.with = &with;
    saving.without = &without;
    const auto more = parse_skips(with.params.skip), less = parse_skips(without.params.skip);
    if (less == SkipSet::none() && (more == SkipSet::all() || with.params.skip == kAutoSkip)) {
        saving.skip = with.params.skip;
        saving.others = SkipSet::none().text();
        return saving;
    }
    if (!more || !less) return {};
    for (const auto& info : skip_infos()) {
        if (info.skip == Skip::cells || less->has(info.skip) || less->with(info.skip) != *more) continue;
        saving.skip = info.key;
        const bool all_others = more->with(Skip::cells) == SkipSet::all();
        const bool no_others = less->without(Skip::cells) == SkipSet::none();
        saving.others = all_others ? SkipSet::all().text() : no_others ? SkipSet::none().text() : less->text();
        return saving;
    }
    return {};
}

SavedWork saved_work(const CellWork& with, const CellWork& without) {
    const auto less = [&](auto CellWork::*count) -> std::optional<int64_t> {
        const std::optional<int64_t> a = without.*count, b = with.*count;
        return a && b ? std::optional(*a - *b) : std::nullopt;
    };
    return {.draws = less(&CellWork::draws),
            .instances = less(&CellWork::instances_drawn),
            .triangles = less(&CellWork::triangles),
            .lights = less(&CellWork::lights_drawn),
            .light_evaluations = less(&CellWork::light_evaluations),
            .moved_bytes_per_px = less(&CellWork::moved_bytes_per_px)};
}

// Nothing where neither was compared with the other, nor were both the same as a third.
std::optional<SkipProof> proof_between(const CellResult& a, const CellResult& b) {
    const auto &of_a = a.skip_proof, &of_b = b.skip_proof;
    if (of_a && of_a->compared_with == b.id) return of_a;
    if (of_b && of_b->compared_with == a.id) return of_b;
    const bool both_as_a_third =
        of_a && of_b && of_a->compared_with == of_b->compared_with && of_a->same_bits && of_b->same_bits;
    return both_as_a_third ? of_a : std::nullopt;
}

double median_saved_ns(const CellResult& with, const CellResult& without) {
    const auto [with_ns, without_ns] =
        pair_by_round(with.samples.round, with.samples.wall_ns, without.samples.round, without.samples.wall_ns);
    std::vector<double> saved(with_ns.size());
    std::ranges::transform(without_ns, with_ns, saved.begin(), std::minus<>());
    return median(saved);
}

void take_times(SkipSaving& saving) {
    if (!saving.with->measured() || !saving.without->measured() || share_samples(*saving.with, *saving.without)) return;
    saving.time = time_ratio(*saving.with, *saving.without, kIntervalLevel);
    if (saving.time) saving.saved_ns = median_saved_ns(*saving.with, *saving.without);
}

}  // namespace

std::vector<SkipSaving> find_skip_savings(const GroupResult& group, std::optional<double> run_floor) {
    std::vector<SkipSaving> savings;
    for (size_t i = 0; i < group.cells.size(); ++i) {
        for (size_t j = i + 1; j < group.cells.size(); ++j) {
            const CellResult &a = group.cells[i], &b = group.cells[j];
            if (!a.work || !b.work || !same_but_skips(a, b)) continue;
            auto saving = saving_of(a, b);
            if (!saving) saving = saving_of(b, a);
            if (saving) savings.push_back(std::move(*saving));
        }
    }
    const auto floor = floor_of(group, run_floor);
    for (auto& saving : savings) {
        const CellResult &with = *saving.with, &without = *saving.without;
        saving.same_work = with.work_key && with.work_key == without.work_key;
        saving.floor = floor;
        saving.work = saved_work(*with.work, *without.work);
        saving.proof = proof_between(with, without);
        take_times(saving);
        if (saving.time && floor) saving.verdict = verdict(saving.time->ratio, *floor);
    }
    return savings;
}

Json to_json(const SkipSaving& saving) {
    using codec::encode;
    const auto& time = saving.time;
    Json json = to_json(saving.with->params);
    json.erase("skip");
    json.update({{"group", saving.with->group},
                 {"skip", saving.skip},
                 {"others", saving.others},
                 {"with", saving.with->id},
                 {"without", saving.without->id},
                 {"same_work", saving.same_work},
                 {"ratio", time ? encode(time->ratio.estimate) : Json(nullptr)},
                 {"low", time ? encode(time->ratio.low) : Json(nullptr)},
                 {"high", time ? encode(time->ratio.high) : Json(nullptr)},
                 {"pairs", time ? time->pairs : 0},
                 {"saved_ns", encode(saving.saved_ns)},
                 {"verdict", word(saving.verdict)},
                 {"floor", encode(saving.floor)},
                 {"saved_work",
                  {{"draws", encode(saving.work.draws)},
                   {"instances", encode(saving.work.instances)},
                   {"triangles", encode(saving.work.triangles)},
                   {"lights", encode(saving.work.lights)},
                   {"light_evaluations", encode(saving.work.light_evaluations)},
                   {"moved_bytes_per_px", encode(saving.work.moved_bytes_per_px)}}},
                 {"proof", saving.proof ? to_json(*saving.proof) : Json(nullptr)}});
    return json;
}

}  // namespace lightsweep
