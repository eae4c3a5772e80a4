#include "bench/report/assemble.h"

#include "bench/report/answers.h"
#include "bench/report/crossovers.h"
#include "bench/report/fastest.h"
#include "bench/report/front.h"
#include "bench/report/json_codec.h"
#include "bench/report/pairs.h"
#include "bench/report/report_file.h"
#include "bench/report/skips.h"

#include "bench/stats/autocorrelation.h"
#include "bench/stats/quantile.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightsweep {
namespace {

using codec::encode;

Json estimate_json(const std::vector<int64_t>& samples_ns) {
    const std::vector<double> samples(samples_ns.begin(), samples_ns.end());
    const auto n = static_cast<double>(samples.size());
    const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / n;
    const double squares = std::accumulate(samples.begin(), samples.end(), 0.0,
                                           [&](double sum, double v) { return sum + (v - mean) * (v - mean); });
    const auto [min, max] = std::ranges::minmax(samples_ns);
    const Interval center = median_interval(samples, kIntervalLevel);
    return {{"median", encode(center.estimate)},
            {"low", encode(center.low)},
            {"high", encode(center.high)},
            {"mean", encode(mean)},
            {"stddev", encode(n > 1.0 ? std::sqrt(squares / (n - 1.0)) : std::nan(""))},
            {"min", min},
            {"max", max},
            {"count", samples.size()},
            {"effective_count", encode(effective_sample_size(sides_of_median(samples)))}};
}

Json statistics_json(const Samples& samples) {
    if (samples.count() == 0) return nullptr;
    Json passes = Json::object();
    for (const auto& [name, pass_ns] : samples.passes) passes[name] = estimate_json(pass_ns);
    return {{"gpu_ns", estimate_json(samples.gpu_ns)},
            {"cpu_ns", estimate_json(samples.cpu_ns)},
            {"wall_ns", estimate_json(samples.wall_ns)},
            {"passes", std::move(passes)}};
}

Json cells_json(const std::vector<GroupResult>& groups) {
    Json cells = Json::array();
    for (const auto& group : groups) {
        for (const auto& cell : group.cells) {
            Json json = to_json(cell);
            json["statistics"] = statistics_json(cell.samples);
            cells.push_back(std::move(json));
        }
    }
    return cells;
}

Json noise_json(const std::vector<GroupResult>& groups, std::optional<double> floor) {
    Json twins = Json::array();
    for (const auto& group : groups) {
        if (!group.noise) continue;
        const auto ratio = noise_ratio(group);
        Json twin{{"group", group.group},
                  {"arm", group.noise->arm},
                  {"ratio", ratio ? encode(ratio->ratio.estimate) : Json(nullptr)},
                  {"low", ratio ? encode(ratio->ratio.low) : Json(nullptr)},
                  {"high", ratio ? encode(ratio->ratio.high) : Json(nullptr)},
                  {"pairs", ratio ? ratio->pairs : 0}};
        twin.update({{"round", encode(group.noise->round)}, {"wall_ns", encode(group.noise->wall_ns)}});
        twins.push_back(std::move(twin));
    }
    return {{"floor", encode(floor)}, {"groups", std::move(twins)}};
}

Json pairs_json(const std::vector<GroupResult>& groups, std::optional<double> run_floor) {
    Json pairs = Json::array();
    for (const auto& group : groups) {
        for (const auto& pair : compare_arms(group, run_floor)) {
            pairs.push_back({{"group", group.group},
                             {"metric", "wall_ns"},
                             {"a", pair.a->id},
                             {"b", pair.b->id},
                             {"ratio", encode(pair.ratio.ratio.estimate)},
                             {"low", encode(pair.ratio.ratio.low)},
                             {"high", encode(pair.ratio.ratio.high)},
                             {"pairs", pair.ratio.pairs},
                             {"verdict", word(pair.verdict)},
                             {"floor", encode(pair.floor)}});
        }
    }
    return pairs;
}

Json arm_json(const CellParams& arm) {
    return {{"path", arm.path},
            {"layout", codec::or_null(arm.layout)},
            {"light_lists", codec::or_null(arm.light_lists)},
            {"hdr", arm.hdr},
            {"skip", arm.skip},
            {"guards", arm.guards},
            {"sums", arm.sums}};
}

// What all arms of one view share.
Json view_json(const CellParams& view) {
    const bool has_regime = view.overlap.value_or(0.0) > 0.0;
    return {{"scene", view.scene},
            {"width_px", view.width},
            {"height_px", view.height},
            {"overlap", has_regime ? Json(*view.overlap) : Json(nullptr)}};
}

Json crossovers_json(const std::vector<GroupResult>& groups, const std::vector<FastestOverLights>& fastest) {
    Json crossovers = Json::array();
    for (const auto& [a, b, on_envelope, crossover] : find_crossovers(groups, fastest)) {
        const auto& lights = crossover.lights;
        Json json = view_json(a);
        json.update({{"a", arm_json(a)},
                     {"b", arm_json(b)},
                     {"on_envelope", on_envelope},
                     {"lights", lights ? encode(lights->estimate) : Json(nullptr)},
                     {"low", lights ? encode(lights->low) : Json(nullptr)},
                     {"high", lights ? encode(lights->high) : Json(nullptr)},
                     {"reason", lights ? Json(nullptr) : Json(crossover.statement)},
                     {"statement", crossover.statement}});
        crossovers.push_back(std::move(json));
    }
    return crossovers;
}

Json fastest_json(const std::vector<FastestOverLights>& fastest) {
    Json result = Json::array();
    for (const auto& [view, ranges] : fastest) {
        Json json = view_json(view);
        json["layout"] = codec::or_null(view.layout);
        json["hdr"] = view.hdr;
        json["skip"] = view.skip;
        json["guards"] = view.guards;
        json["sums"] = view.sums;
        json["ranges"] = Json::array();
        for (const auto& range : ranges) {
            Json rivals = Json::array();
            for (const auto& rival : range.rivals) rivals.push_back(arm_json(rival));
            json["ranges"].push_back({{"from_lights", range.from_lights},
                                      {"to_lights", range.to_lights},
                                      {"arm", arm_json(range.arm)},
                                      {"surely", range.surely},
                                      {"rivals", std::move(rivals)}});
        }
        result.push_back(std::move(json));
    }
    return result;
}

Json skips_json(const std::vector<GroupResult>& groups, std::optional<double> run_floor) {
    Json skips = Json::array();
    for (const auto& group : groups) {
        for (const auto& saving : find_skip_savings(group, run_floor)) skips.push_back(to_json(saving));
    }
    return skips;
}

Json references_json(const std::vector<GroupResult>& groups) {
    Json references = Json::array();
    for (const auto& group : groups) {
        if (!group.reference) continue;
        Json reference{{"group", group.group}};
        reference.update(to_json(*group.reference));
        references.push_back(std::move(reference));
    }
    return references;
}

// The cells on the front, the fastest first.
Json front_json(const std::vector<TimeErrorPoint>& points, const std::vector<FrontState>& states) {
    std::vector<TimeErrorPoint> front;
    for (size_t i = 0; i < points.size(); ++i) {
        if (states[i] == FrontState::front) front.push_back(points[i]);
    }
    std::ranges::stable_sort(front, {}, [](const auto& point) { return point.time_ns.estimate; });
    Json ids = Json::array();
    for (const auto& point : front) ids.push_back(point.cell->id);
    return ids;
}

Json pareto_json(const std::vector<GroupResult>& groups, std::optional<double> run_floor) {
    Json result = Json::array();
    for (const auto& group : groups) {
        const auto points = time_error_points(group, kErrorMetric);
        if (points.empty()) continue;
        const auto states = front_states(points, floor_of(group, run_floor));
        Json group_json{{"group", group.group},
                        {"metric_time", "wall_ns"},
                        {"metric_error", error_key(kErrorMetric)},
                        {"front", front_json(points, states)},
                        {"perhaps", Json::array()},
                        {"dominated", Json::array()},
                        {"points", Json::array()}};
        for (size_t i = 0; i < points.size(); ++i) {
            const auto& [cell, time_ns, error] = points[i];
            if (states[i] != FrontState::front) group_json[std::string(word(states[i]))].push_back(cell->id);
            group_json["points"].push_back({{"id", cell->id},
                                            {"state", word(states[i])},
                                            {"time_ns", encode(time_ns.estimate)},
                                            {"time_low_ns", encode(time_ns.low)},
                                            {"time_high_ns", encode(time_ns.high)},
                                            {"error", encode(error.estimate)},
                                            {"error_low", encode(error.low)},
                                            {"error_high", encode(error.high)}});
        }
        result.push_back(std::move(group_json));
    }
    return result;
}

Json answers_json(const JournalContent& journal, std::optional<double> floor) {
    Json answers = Json::array();
    for (const auto& answer : answer_questions(journal.run, journal.groups, floor)) answers.push_back(to_json(answer));
    return answers;
}

Json summary_json(const JournalContent& journal) {
    Json counts = Json::object();
    for (const auto& name : kCellStatusNames) counts[name] = 0;
    int64_t cells = 0;
    for (const auto& group : journal.groups) {
        for (const auto& cell : group.cells) {
            auto& count = counts[kCellStatusNames[static_cast<size_t>(cell.status)]];
            count = count.get<int64_t>() + 1;
            ++cells;
        }
    }
    return {{"planned", journal.run.planned_cells},
            {"counts", std::move(counts)},
            {"complete", cells == journal.run.planned_cells}};
}

Json run_json(const JournalContent& journal, bool complete) {
    double wall_s = 0.0;
    double frames_s = 0.0;
    for (const auto& group : journal.groups) {
        wall_s += group.wall_s;
        frames_s += group.frames_s;
    }
    Json run = to_json(journal.run);
    run["wall_s"] = encode(wall_s);
    run["stopped_because"] = complete ? "complete" : "interrupted";
    run["frames_share"] = wall_s > 0.0 ? encode(frames_s / wall_s) : Json(0.0);
    return run;
}

}  // namespace

Json assemble_report(const JournalContent& journal) {
    const auto floor = noise_floor(journal.groups);
    const auto fastest = find_fastest(journal.groups, floor);
    Json summary = summary_json(journal);
    return {{"schema", kReportSchema},
            {"run", run_json(journal, summary.at("complete").get<bool>())},
            {"environment", to_json(journal.environment)},
            {"timer", to_json(journal.timer)},
            {"noise", noise_json(journal.groups, floor)},
            {"references", references_json(journal.groups)},
            {"cells", cells_json(journal.groups)},
            {"pairs", pairs_json(journal.groups, floor)},
            {"crossovers", crossovers_json(journal.groups, fastest)},
            {"fastest", fastest_json(fastest)},
            {"pareto", pareto_json(journal.groups, floor)},
            {"answers", answers_json(journal, floor)},
            {"skips", skips_json(journal.groups, floor)},
            {"summary", std::move(summary)}};
}

}  // namespace lightsweep
