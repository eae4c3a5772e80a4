// Deferred with light volumes: each point or spot light shades only the pixels whose surface is inside its sphere or
// cone, found with the stencil (depth-fail counting, right when the camera is inside the volume too). What no volume
// bounds is shaded full-screen first. Without Skip::light_depth a volume shades all that it covers of the screen.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

enum : size_t { kMark, kShade };

// A surface inside the volume lies between its front and back faces: the back faces fail the depth test there, the
// front faces do not. Counted on the volume clamped to the depth range, so that neither near nor far plane opens it.
// Nothing clamped is behind the background, which is therefore never marked.
// Blends like shade_state: what both share is not switched for each light.
gl::RasterState mark_state(DepthConvention convention) {
    gl::RasterState state{
        .depth_test = true, .depth_clamp = true, .blend = gl::Blend::add, .color_write = false, .stencil_test = true};
    state.depth_compare =
        convention == DepthConvention::reversed ? gl::Compare::greater_equal : gl::Compare::less_equal;
    state.stencil_back.depth_fail = gl::StencilOp::increment_wrap;
    state.stencil_front.depth_fail = gl::StencilOp::decrement_wrap;
    return state;
}

// The volume's back faces cover the marked pixels wherever the camera is; each mark is wiped as it is shaded.
gl::RasterState shade_state() {
    gl::RasterState state{.depth_clamp = true, .cull = gl::Cull::front, .blend = gl::Blend::add, .stencil_test = true};
    state.stencil_back = {.compare = gl::Compare::not_equal, .pass = gl::StencilOp::zero};
    state.stencil_front = state.stencil_back;
    return state;
}

// Every pixel behind a volume's near side, whatever it shows: the camera may be inside, so the back faces are drawn.
gl::RasterState whole_state() { return {.depth_clamp = true, .cull = gl::Cull::front}; }

template <class DrawLight>
void for_each_light(Recorder& recorder, DrawLight draw_light) {
    const auto& data = recorder.frame().data;
    recorder.bind_light_volumes();
    for (uint32_t light = data.directional_count; light < data.light_count; ++light) draw_light(light);
}

void draw_marked_lights(Recorder& recorder) {
    for_each_light(recorder, [&](uint32_t light) {
        recorder.use_stage(kMark);
        recorder.draw_light_volume(light);
        recorder.use_stage(kShade);
        recorder.draw_light_volume(light);
    });
}

void draw_whole_lights(Recorder& recorder) {
    for_each_light(recorder, [&](uint32_t light) { recorder.draw_light_volume(light); });
}

// What lib/light_volume.glsl wants to know of how surfaces are stored.
std::vector<std::string> volume_defines(const Layout& layout) {
    return {fmt::format("POSITION_ERROR {:.9e}", position_error(layout)),
            fmt::format("DEPTH_STEP {:.9e}", depth_step(gl::with_stencil(layout.depth), layout.convention))};
}

std::vector<std::string> shade_defines(const Layout& layout) {
    auto defines = gbuffer_read_defines(layout);
    for (auto& define : volume_defines(layout)) defines.push_back(std::move(define));
    return defines;
}

// Reads the depth that is attached: allowed in practice because no draw of this pass writes depth, only stencil.
Pass marked_lights(const PathSetup& s, const std::vector<TargetId>& targets, const Path& path) {
    return {.name = "lights",
            .shader = {"paths/light_volume", "paths/light_volume_mark", volume_defines(s.layout)},
            .reads = join(targets, path.depth),
            .writes = {{path.hdr, Load::keep}, {path.depth, Load::keep}},
            .state = mark_state(s.layout.convention),
            .record = draw_marked_lights,
            .shades = Shades::one_light,
            .more_stages = {{{"paths/light_volume", "paths/resolve_light", shade_defines(s.layout)}, shade_state()}}};
}

Pass whole_lights(const PathSetup& s, const std::vector<TargetId>& targets, const Path& path) {
    return {.name = "lights",
            .shader = {"paths/light_volume", "paths/resolve_light", join(shade_defines(s.layout), "MAY_BE_BACKGROUND")},
            .reads = join(targets, path.depth),
            .writes = {{path.hdr, Load::keep}},
            .state = whole_state(),
            .record = draw_whole_lights,
            .shades = Shades::one_light};
}

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = gl::with_stencil(s.layout.depth)});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, gbuffer_pass(s, targets, path.depth), path);
    if (draws_base(s)) path.passes.push_back(base_pass(s, targets, path));
    const bool marked = s.skips.has(Skip::light_depth);
    path.passes.push_back(
        adding_lights(s, marked ? marked_lights(s, targets, path) : whole_lights(s, targets, path), path));
    return path;
}

}  // namespace

extern const PathInfo path_deferred_volumes;
const PathInfo path_deferred_volumes{.key = "deferred_volumes",
                                     .summary = "G-buffer, then a stencil-marked sphere or cone for each light",
                                     .uses_layout = true,
                                     .build = build};

}  // namespace lightsweep
