#include "bench/measure/cell_work.h"

#include "renderer/gbuffer/layout.h"

#include <string>

namespace lightsweep {
namespace {

std::string key(Skip skip) { return std::string(skip_key(skip)); }

// What a frame did without, in the skip's own unit; what it found nothing of is not there.
std::map<std::string, int64_t> skipped_work(const Arm& arm, const CellParams& drawn) {
    const FrameWork& work = arm.frame().work;
    const int whole_layout = drawn.layout.empty() ? 0 : load_layout(drawn.layout).bytes_per_pixel();
    const int layout = drawn.layout.empty() ? 0 : arm.setup().layout.bytes_per_pixel();
    std::map<std::string, int64_t> skipped{
        {key(Skip::frustum), static_cast<int64_t>(work.instances_culled)},
        {key(Skip::light_frustum), static_cast<int64_t>(work.lights_culled)},
        {key(Skip::occlusion), static_cast<int64_t>(arm.path().hidden_instances())},
        {key(Skip::passes), arm.path().idle_passes()},
        {key(Skip::fields), whole_layout - layout},
    };
    std::erase_if(skipped, [](const auto& entry) { return entry.second == 0; });
    return skipped;
}

}  // namespace

CellWork cell_work(const Arm& arm, const Subject& subject, const CellParams& drawn) {
    const FrameWork& work = arm.frame().work;
    CellWork result;
    result.draws = static_cast<int64_t>(work.draws) - arm.path().saved_draws();
    result.triangles = static_cast<int64_t>(work.triangles - arm.path().hidden_triangles());
    result.instances_drawn = static_cast<int64_t>(work.instances_drawn - arm.path().hidden_instances());
    result.instances_culled = static_cast<int64_t>(work.instances_culled);
    result.lights_drawn = static_cast<int64_t>(work.lights_drawn);
    result.lights_culled = static_cast<int64_t>(work.lights_culled);
    result.gbuffer_bytes_per_px = arm.setup().layout.targets.empty() ? 0 : arm.setup().layout.bytes_per_pixel();
    result.target_bytes_per_px = arm.path().bytes_per_pixel();
    result.moved_bytes_per_px = arm.path().moved_bytes_per_pixel();
    result.memory_bytes = static_cast<int64_t>(arm.path().memory_bytes() + subject.scene.memory_bytes());
    result.skipped = skipped_work(arm, drawn);
    return result;
}

void count_lights(Arm& arm, std::optional<int64_t> light_hits, CellWork& work) {
    const auto evaluations = static_cast<int64_t>(arm.count_light_evaluations());
    work.light_evaluations = evaluations;
    if (light_hits && evaluations > 0) {
        work.false_positive_rate = 1.0 - static_cast<double>(*light_hits) / static_cast<double>(evaluations);
    }
    if (const LightListService* lists = arm.path().light_lists()) {
        work.list_entries = static_cast<int64_t>(lists->read().indices.size());
    }
}

CellWork like_settled(const CellWork& settled, const CellWork& first) {
    CellWork work = settled;
    // Equal work may be what is left of different scenes: more lights out of view, or a layout with more to drop.
    work.instances_culled = first.instances_culled;
    work.lights_culled = first.lights_culled;
    for (const Skip skip : {Skip::frustum, Skip::light_frustum, Skip::fields}) {
        work.skipped.erase(key(skip));
        const auto found = first.skipped.find(key(skip));
        if (found != first.skipped.end()) work.skipped.insert(*found);
    }
    return work;
}

}  // namespace lightsweep
