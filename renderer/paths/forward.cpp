// Forward: one pass; each fragment that is nearest so far is shaded with every light.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s,
                  {.name = "forward",
                   .shader = {"paths/mesh", "paths/forward"},
                   .writes = {{path.hdr, Load::clear}, {path.depth, Load::clear}},
                   .state = opaque_state(s.layout.convention),
                   .record = draw_visible_meshes,
                   .shades = Shades::all_lights},
                  path);
    return path;
}

}  // namespace

extern const PathInfo path_forward;
const PathInfo path_forward{
    .key = "forward", .summary = "one pass, every light for every fragment", .uses_layout = false, .build = build};

}  // namespace lightsweep
