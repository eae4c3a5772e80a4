// Deferred with light volumes: each point or spot light shades only the pixels whose surface is inside its sphere,
// found with the stencil (depth-fail counting, right when the camera is inside the sphere too). What no sphere bounds
// is shaded full-screen first.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

namespace lightsweep {
namespace {

enum : size_t { kMark, kShade };

// A surface inside the sphere lies between its front and back faces: the back faces fail the depth test there, the
// front faces do not. Counted on the sphere clamped to the depth range, so that neither near nor far plane opens it.
gl::RasterState mark_state(DepthConvention convention) {
    gl::RasterState state{.depth_test = true, .depth_clamp = true, .color_write = false, .stencil_test = true};
    state.depth_compare = convention == DepthConvention::reversed ? gl::Compare::greater : gl::Compare::less;
    state.stencil_back.depth_fail = gl::StencilOp::increment_wrap;
    state.stencil_front.depth_fail = gl::StencilOp::decrement_wrap;
    return state;
}

// The sphere's back faces cover the marked pixels wherever the camera is; each mark is wiped as it is shaded.
gl::RasterState shade_state() {
    gl::RasterState state{.depth_clamp = true, .cull = gl::Cull::front, .blend = gl::Blend::add, .stencil_test = true};
    state.stencil_back = {.compare = gl::Compare::not_equal, .pass = gl::StencilOp::zero};
    state.stencil_front = state.stencil_back;
    return state;
}

void draw_lights(Recorder& recorder) {
    const auto& data = recorder.frame().data;
    recorder.bind_light_volume();
    for (uint32_t light = data.directional_count; light < data.light_count; ++light) {
        recorder.use_stage(kMark);
        recorder.draw_light_volume(light);
        recorder.use_stage(kShade);
        recorder.draw_light_volume(light);
    }
}

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = gl::with_stencil(s.layout.depth)});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    const auto read_defines = gbuffer_read_defines(s.layout);
    path.passes = {
        gbuffer_pass(s, targets, path.depth),
        {.name = "base",
         .shader = {"paths/fullscreen", "paths/resolve_base", read_defines},
         .reads = join(targets, path.depth),
         .writes = {{path.hdr, Load::discard}},
         .record = draw_full_screen,
         .shades = Shades::directional_of_covered},
        // Reads the depth that is attached: allowed in practice because no draw of this pass writes depth, only
        // stencil.
        {.name = "lights",
         .shader = {"paths/light_volume", "paths/light_volume_mark"},
         .reads = join(targets, path.depth),
         .writes = {{path.hdr, Load::keep}, {path.depth, Load::keep}},
         .state = mark_state(s.layout.convention),
         .record = draw_lights,
         .shades = Shades::one_light,
         .more_stages = {{{"paths/light_volume", "paths/light_volume", read_defines}, shade_state()}}},
    };
    return path;
}

}  // namespace

extern const PathInfo path_deferred_volumes;
const PathInfo path_deferred_volumes{.key = "deferred_volumes",
                                     .summary = "G-buffer, then a stencil-marked sphere for each light",
                                     .uses_layout = true,
                                     .build = build};

}  // namespace lightsweep
