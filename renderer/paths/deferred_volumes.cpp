// Deferred with light volumes: each point or spot light shades only the pixels whose surface is inside its sphere or
// cone, found with the stencil (depth-fail counting, right when the camera is inside the volume too). What no volume
// bounds is shaded full-screen first.
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

void draw_lights(Recorder& recorder) {
    const auto& data = recorder.frame().data;
    recorder.bind_light_volumes();
    for (uint32_t light = data.directional_count; light < data.light_count; ++light) {
        recorder.use_stage(kMark);
        recorder.draw_light_volume(light);
        recorder.use_stage(kShade);
        recorder.draw_light_volume(light);
    }
}

// What lib/light_volume.glsl wants to know of how surfaces are stored.
std::vector<std::string> volume_defines(const Layout& layout) {
    return {fmt::format("POSITION_ERROR {:.9e}", position_error(layout)),
            fmt::format("DEPTH_STEP {:.9e}", depth_step(gl::with_stencil(layout.depth), layout.convention))};
}

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = gl::with_stencil(s.layout.depth)});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    const auto defines = volume_defines(s.layout);
    auto shade_defines = gbuffer_read_defines(s.layout);
    shade_defines.insert(shade_defines.end(), defines.begin(), defines.end());
    path.passes = {
        gbuffer_pass(s, targets, path.depth),
        base_pass(s, targets, path),
        // Reads the depth that is attached: allowed in practice because no draw of this pass writes depth, only
        // stencil.
        {.name = "lights",
         .shader = {"paths/light_volume", "paths/light_volume_mark", defines},
         .reads = join(targets, path.depth),
         .writes = {{path.hdr, Load::keep}, {path.depth, Load::keep}},
         .state = mark_state(s.layout.convention),
         .record = draw_lights,
         .shades = Shades::one_light,
         .more_stages = {{{"paths/light_volume", "paths/resolve_light", shade_defines}, shade_state()}}},
    };
    return path;
}

}  // namespace

extern const PathInfo path_deferred_volumes;
const PathInfo path_deferred_volumes{.key = "deferred_volumes",
                                     .summary = "G-buffer, then a stencil-marked sphere or cone for each light",
                                     .uses_layout = true,
                                     .build = build};

}  // namespace lightsweep
