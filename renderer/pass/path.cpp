#include "renderer/pass/path.h"

#include "renderer/pass/recorder.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

// For shaders with sum_lights.
std::vector<std::string> grid_defines(const Path& path) {
    return path.light_grid ? std::vector<std::string>{"LIGHT_GRID"} : std::vector<std::string>{};
}

}  // namespace

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

std::vector<std::string> join(std::vector<std::string> defines, std::string one_more) {
    defines.push_back(std::move(one_more));
    return defines;
}

gl::RasterState opaque_state(DepthConvention convention) {
    return {.depth_test = true,
            .depth_write = true,
            .depth_compare = convention == DepthConvention::reversed ? gl::Compare::greater : gl::Compare::less};
}

gl::RasterState equal_state() { return {.depth_test = true, .depth_compare = gl::Compare::equal}; }

Pass depth_prepass(const PathSetup& setup, TargetId depth) {
    return {.name = "prepass",
            .shader = {"paths/mesh", "paths/depth", {"DEPTH_ONLY"}},
            .writes = {{depth, Load::clear}},
            .state = opaque_state(setup.layout.convention),
            .record = draw_visible_meshes};
}

Pass gbuffer_pass(const PathSetup& setup, const std::vector<TargetId>& targets, TargetId depth) {
    return {.name = "gbuffer",
            .shader = {"paths/mesh", "paths/gbuffer"},
            .writes = join(all(targets, Load::discard), {depth, Load::clear}),
            .state = opaque_state(setup.layout.convention),
            .record = draw_visible_meshes};
}

void list_lights(const PathSetup& setup, const LightGridDesc& grid, Path& path) {
    path.light_grid = grid;
    if (grid.depth_bounds) {
        path.tile_depth = path.add({.name = "tile depth", .format = gl::Format::RG32F, .px_per_texel = grid.tile_px});
        path.passes.push_back(
            {.name = "tile_depth",
             .shader = {"paths/fullscreen",
                        "lists/tile_depth",
                        {fmt::format("TILE_PX {}", grid.tile_px),
                         fmt::format("DEPTH_STEP {:.9e}", depth_step(setup.layout.depth, setup.layout.convention))}},
             .reads = {path.depth},
             .writes = {{path.tile_depth, Load::discard}},
             .record = draw_full_screen});
    }
    if (grid.depth_bounds || setup.light_lists == ListBuilder::compute) {
        path.passes.push_back({.name = "light_lists", .record = build_lists});
    }
}

Pass forward_pass(const Path& path) {
    return {.name = "forward",
            .shader = {"paths/mesh", "paths/forward", grid_defines(path)},
            .writes = {{path.hdr, Load::clear}, {path.depth, Load::keep}},
            .state = equal_state(),
            .record = draw_visible_meshes,
            .shades = path.light_grid ? Shades::listed_lights_of_covered : Shades::all_lights};
}

Pass resolve_pass(const PathSetup& setup, const std::vector<TargetId>& targets, const Path& path) {
    auto defines = gbuffer_read_defines(setup.layout);
    for (auto& define : grid_defines(path)) defines.push_back(std::move(define));
    return {.name = "shade",
            .shader = {"paths/fullscreen", "paths/resolve", std::move(defines)},
            .reads = join(targets, path.depth),
            .writes = {{path.hdr, Load::discard}},
            .record = draw_full_screen,
            .shades = path.light_grid ? Shades::listed_lights_of_covered : Shades::all_lights_of_covered};
}

Pass base_pass(const PathSetup& setup, const std::vector<TargetId>& targets, const Path& path) {
    return {.name = "base",
            .shader = {"paths/fullscreen", "paths/resolve_base", gbuffer_read_defines(setup.layout)},
            .reads = join(targets, path.depth),
            .writes = {{path.hdr, Load::discard}},
            .record = draw_full_screen,
            .shades = Shades::directional_of_covered};
}

std::vector<std::string> gbuffer_read_defines(const Layout& layout) {
    return {fmt::format("DEPTH_UNIT {}", shared::kTargetUnit + static_cast<int>(layout.targets.size()))};
}

}  // namespace lightsweep
