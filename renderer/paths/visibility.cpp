// Visibility buffer (Burns and Hunt 2013): geometry leaves nothing but which triangle each pixel shows, 8 bytes, and
// its material in the stencil. Then, material by material, a full-screen pass rebuilds the surfaces from their
// triangles and shades them.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

namespace lightsweep {
namespace {

gl::RasterState mark_state(DepthConvention convention) {
    gl::RasterState state = opaque_state(convention);
    state.stencil_test = true;
    state.stencil_front.pass = gl::StencilOp::replace;
    state.stencil_back = state.stencil_front;
    return state;
}

gl::RasterState shade_state() {
    gl::RasterState state{.stencil_test = true};
    state.stencil_front.compare = gl::Compare::equal;
    state.stencil_back = state.stencil_front;
    return state;
}

Path build(const PathSetup& s) {
    Path path;
    const TargetId triangles = path.add({.name = "visible triangles", .format = gl::Format::RG32UI});
    path.depth = path.add({.name = "depth", .format = gl::with_stencil(s.layout.depth)});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s,
                  {.name = "visibility",
                   .shader = {"paths/mesh", "paths/visible_triangle", {"DEPTH_ONLY", "OUTPUT_INSTANCE"}},
                   .writes = {{triangles, Load::discard}, {path.depth, Load::clear}},
                   .state = mark_state(s.layout.convention),
                   .record = [](Recorder& recorder) { recorder.draw_visible_meshes_marking_materials(); }},
                  path);
    path.passes.push_back({.name = "shade",
                           .shader = {"paths/fullscreen", "paths/visibility_shade"},
                           .reads = {triangles},
                           .writes = {{path.hdr, Load::clear}, {path.depth, Load::keep}},
                           .state = shade_state(),
                           .record = [](Recorder& recorder) { recorder.draw_full_screen_per_material(); },
                           .shades = Shades::all_lights_of_covered});
    return path;
}

}  // namespace

extern const PathInfo path_visibility;
const PathInfo path_visibility{.key = "visibility",
                               .summary = "triangle ids alone, then attributes rebuilt per pixel",
                               .uses_layout = false,
                               .build = build};

}  // namespace lightsweep
