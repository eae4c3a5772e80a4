#include "bench/report/sound.h"

#include "renderer/base/error.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

void require_length(const std::vector<int64_t>& values, size_t length, const std::string& where) {
    if (values.size() == length) return;
    throw InputError(where,
                     fmt::format("{} frames were expected, as many as in 'wall_ns', not {}", length, values.size()));
}

}  // namespace

void require_sound(const CellResult& cell, const std::string& where) {
    const Samples& samples = cell.samples;
    const std::string here = where + "/samples";
    require_length(samples.round, samples.count(), here + "/round");
    require_length(samples.cpu_ns, samples.count(), here + "/cpu_ns");
    require_length(samples.gpu_ns, samples.count(), here + "/gpu_ns");
    for (const auto& [pass, times_ns] : samples.passes) {
        require_length(times_ns, samples.count(), here + "/passes/" + pass);
    }
}

void require_sound(const GroupResult& group, const std::string& where) {
    for (size_t i = 0; i < group.cells.size(); ++i) {
        require_sound(group.cells[i], fmt::format("{}/cells/{}", where, i));
    }
    if (group.noise) require_length(group.noise->round, group.noise->wall_ns.size(), where + "/noise/round");
}

}  // namespace lightsweep
