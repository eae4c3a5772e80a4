// Deferred: geometry fills the G-buffer once; one full-screen pass shades each pixel with every light.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    path.passes = {
        gbuffer_pass(s, targets, path.depth),
        {.name = "shade",
         .shader = {"paths/fullscreen", "paths/resolve", gbuffer_read_defines(s.layout)},
         .reads = join(targets, path.depth),
         .writes = {{path.hdr, Load::discard}},
         .record = draw_full_screen,
         .shades = Shades::all_lights_of_covered},
    };
    return path;
}

}  // namespace

extern const PathInfo path_deferred;
const PathInfo path_deferred{.key = "deferred",
                             .summary = "G-buffer, then one full-screen pass with every light",
                             .uses_layout = true,
                             .build = build};

}  // namespace lightsweep
