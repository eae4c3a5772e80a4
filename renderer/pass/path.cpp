#include "renderer/pass/path.h"

#include "renderer/frame/occlusion.h"
#include "renderer/pass/recorder.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

// For shaders with sum_lights.
std::vector<std::string> grid_defines(const Path& path) {
    return path.light_grid ? std::vector<std::string>{"LIGHT_GRID"} : std::vector<std::string>{};
}

// The range of view distances in each tile of the picture.
Pass tile_depth_pass(const PathSetup& setup, std::string name, int tile_px, std::vector<std::string> defines,
                     TargetId depth, TargetId tile_depth) {
    defines.push_back(fmt::format("TILE_PX {}", tile_px));
    defines.push_back(fmt::format("DEPTH_STEP {:.9e}", depth_step(setup.layout.depth, setup.layout.convention)));
    return {.name = std::move(name),
            .shader = {"paths/fullscreen", "lists/tile_depth", std::move(defines)},
            .reads = {depth},
            .writes = {{tile_depth, Load::discard}},
            .record = draw_full_screen};
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

Pass over_surfaces(const PathSetup& setup, Pass pass, const Path& path) {
    if (!setup.skips.has(Skip::background)) {
        pass.shader.defines.emplace_back("MAY_BE_BACKGROUND");
        return pass;
    }
    // The full-screen triangle lies where the background is: a surface is nearer.
    pass.shader.defines.emplace_back("COVERED_ONLY");
    pass.state.depth_test = true;
    pass.state.depth_compare =
        setup.layout.convention == DepthConvention::reversed ? gl::Compare::less : gl::Compare::greater;
    for (Write& write : pass.writes) {
        if (write.target == path.hdr && write.load == Load::discard) write.load = Load::clear;
    }
    // Attached and read: allowed in practice because the pass does not write it.
    pass.writes.push_back({path.depth, Load::keep});
    return pass;
}

void draw_geometry(const PathSetup& setup, Pass pass, Path& path) {
    if (!setup.skips.has(Skip::occlusion) || !setup.needs.several_instances()) {
        path.passes.push_back(std::move(pass));
        return;
    }
    constexpr int kTilePx = OcclusionCuller::kTilePx;
    path.occluder_depth = path.add({.name = "occluder depth", .format = gl::Format::RG32F, .px_per_texel = kTilePx});
    Pass rest = pass;
    rest.name += "_rest";
    rest.instances = Instances::newly_seen;
    rest.idle = Idle::without_instances;
    for (Write& write : rest.writes) write.load = Load::keep;
    pass.instances = Instances::seen_before;
    path.passes.push_back(std::move(pass));
    Pass tile_depth =
        tile_depth_pass(setup, "occluder_depth", kTilePx, {"WITH_BACKGROUND"}, path.depth, path.occluder_depth);
    tile_depth.idle = Idle::without_occlusion;
    path.passes.push_back(std::move(tile_depth));
    path.passes.push_back({.name = "occlusion",
                           .reads = {path.occluder_depth},
                           .record = find_hidden_instances,
                           .idle = Idle::without_occlusion});
    path.passes.push_back(std::move(rest));
}

void list_lights(const PathSetup& setup, LightGridDesc grid, Path& path) {
    if (!setup.skips.has(Skip::light_lists)) return;
    grid.depth_bounds = grid.depth_bounds && setup.skips.has(Skip::light_depth);
    path.light_grid = grid;
    if (grid.depth_bounds) {
        path.tile_depth = path.add({.name = "tile depth", .format = gl::Format::RG32F, .px_per_texel = grid.tile_px});
        Pass tile_depth = tile_depth_pass(setup, "tile_depth", grid.tile_px, {}, path.depth, path.tile_depth);
        tile_depth.idle = Idle::without_local_lights;  // no list asks for it then
        path.passes.push_back(std::move(tile_depth));
        path.passes.push_back({.name = "light_lists", .reads = {path.tile_depth}, .record = build_lists});
    } else if (setup.light_lists == ListBuilder::compute) {
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
    return over_surfaces(setup,
                         {.name = "shade",
                          .shader = {"paths/fullscreen", "paths/resolve", std::move(defines)},
                          .reads = join(targets, path.depth),
                          .writes = {{path.hdr, Load::discard}},
                          .record = draw_full_screen,
                          .shades = path.light_grid ? Shades::listed_lights_of_covered : Shades::all_lights_of_covered},
                         path);
}

Pass base_pass(const PathSetup& setup, const std::vector<TargetId>& targets, const Path& path) {
    return over_surfaces(setup,
                         {.name = "base",
                          .shader = {"paths/fullscreen", "paths/resolve_base", gbuffer_read_defines(setup.layout)},
                          .reads = join(targets, path.depth),
                          .writes = {{path.hdr, Load::discard}},
                          .record = draw_full_screen,
                          .shades = Shades::directional_of_covered},
                         path);
}

bool draws_base(const PathSetup& setup) { return setup.needs.base() || !setup.skips.has(Skip::passes); }

Pass adding_lights(const PathSetup& setup, Pass pass, const Path& path) {
    pass.state.blend = gl::Blend::add;
    for (Write& write : pass.writes) {
        if (write.target == path.hdr) write.load = draws_base(setup) ? Load::keep : Load::clear;
    }
    if (draws_base(setup)) pass.idle = Idle::without_local_lights;
    return pass;
}

std::vector<std::string> gbuffer_read_defines(const Layout& layout) {
    return {fmt::format("DEPTH_UNIT {}", shared::kTargetUnit + static_cast<int>(layout.targets.size()))};
}

}  // namespace lightsweep
