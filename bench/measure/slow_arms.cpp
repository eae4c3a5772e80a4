#include "bench/measure/slow_arms.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

// Scene, size and overlap among it: a cell but for its lights.
std::string arm_key(CellParams params) {
    params.lights.reset();
    return params.name();
}

}  // namespace

void SlowArms::remember(const GroupResult& group) {
    for (const auto& cell : group.cells) {
        if (cell.status != CellStatus::timeout || !cell.too_slow_at_lights) continue;
        if (cell.params.path == kAutoPath) continue;  // it may come to another path with more lights
        const int64_t lights = *cell.too_slow_at_lights;
        const auto [found, is_new] = by_arm_.try_emplace(arm_key(cell.params));
        if (!is_new && found->second.lights <= lights) continue;
        found->second = {lights, fmt::format("not drawn: with {} lights {}", lights, cell.reason.value_or(""))};
    }
}

std::optional<SlowArms::Found> SlowArms::find(const CellParams& params) const {
    const auto found = by_arm_.find(arm_key(params));
    if (found == by_arm_.end() || !params.lights || *params.lights < found->second.lights) return {};
    return found->second;
}

}  // namespace lightsweep
