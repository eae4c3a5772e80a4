#include "renderer/pass/path.h"

#include "renderer/pass/recorder.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

namespace lightsweep {

std::vector<TargetId> Path::add(const std::vector<LayoutTarget>& layout_targets) {
    std::vector<TargetId> ids;
    for (const auto& target : layout_targets) ids.push_back(add({.name = target.name, .format = target.format}));
    return ids;
}

std::vector<Write> all(const std::vector<TargetId>& targets, Load load) {
    std::vector<Write> writes;
    for (const TargetId target : targets) writes.push_back({target, load});
    return writes;
}

std::vector<TargetId> join(std::vector<TargetId> targets, TargetId one_more) {
    targets.push_back(one_more);
    return targets;
}

std::vector<Write> join(std::vector<Write> writes, Write one_more) {
    writes.push_back(one_more);
    return writes;
}

gl::RasterState opaque_state(DepthConvention convention) {
    return {.depth_test = true,
            .depth_write = true,
            .depth_compare = convention == DepthConvention::reversed ? gl::Compare::greater : gl::Compare::less};
}

gl::RasterState equal_state() { return {.depth_test = true, .depth_compare = gl::Compare::equal}; }

Pass gbuffer_pass(const PathSetup& setup, const std::vector<TargetId>& targets, TargetId depth) {
    return {.name = "gbuffer",
            .shader = {"paths/mesh", "paths/gbuffer"},
            .writes = join(all(targets, Load::discard), {depth, Load::clear}),
            .state = opaque_state(setup.layout.convention),
            .record = draw_visible_meshes};
}

std::vector<std::string> gbuffer_read_defines(const Layout& layout) {
    return {fmt::format("DEPTH_UNIT {}", shared::kTargetUnit + static_cast<int>(layout.targets.size()))};
}

}  // namespace lightsweep
