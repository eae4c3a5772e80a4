#include "bench/report/crossovers.h"

#include "bench/report/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace lightsweep {
namespace {

struct Series {
    CellParams a;
    CellParams b;
    std::map<double, Interval> ratio_at;  // light count -> a over b
};

// `deferred (oct32)`, as a sentence can say it.
std::string words(const CellParams& arm) {
    return arm.layout.empty() ? arm.path : fmt::format("{} ({})", arm.path, arm.layout);
}

const CellResult* forward_twin(const GroupResult& group, const CellResult& arm) {
    const auto twin = std::ranges::find_if(group.cells, [&](const CellResult& other) {
        return other.measured() && other.params.path == kBaselinePath && other.params.hdr == arm.params.hdr;
    });
    return twin == group.cells.end() ? nullptr : &*twin;
}

CellParams without_lights(CellParams arm) {
    arm.lights.reset();
    return arm;
}

}  // namespace

std::vector<ArmCrossover> find_crossovers(const std::vector<GroupResult>& groups) {
    std::vector<Series> all;
    for (const auto& group : groups) {
        for (const auto& arm : group.cells) {
            const CellResult* forward = forward_twin(group, arm);
            if (!arm.measured() || arm.params.path == kBaselinePath || !forward || !arm.params.lights) continue;
            const auto ratio = time_ratio(arm, *forward, kIntervalLevel);
            if (!ratio) continue;
            const CellParams a = without_lights(arm.params);
            auto series = std::ranges::find(all, a, &Series::a);
            if (series == all.end()) {
                series = all.insert(all.end(), {.a = a, .b = without_lights(forward->params), .ratio_at = {}});
            }
            series->ratio_at.try_emplace(*arm.params.lights, ratio->ratio);
        }
    }
    std::vector<ArmCrossover> result;
    for (const auto& series : all) {
        if (series.ratio_at.size() < 2) continue;
        std::vector<double> lights;
        std::vector<Interval> ratios;
        for (const auto& [count, ratio] : series.ratio_at) {
            lights.push_back(count);
            ratios.push_back(ratio);
        }
        result.push_back({series.a, series.b, find_crossover(lights, ratios, words(series.a), words(series.b))});
    }
    return result;
}

}  // namespace lightsweep
