// Deferred: geometry fills the G-buffer once; one full-screen pass shades each pixel with every light.
#include "renderer/pass/path.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, gbuffer_pass(s, targets, path.depth), path);
    path.passes.push_back(resolve_pass(s, targets, path));
    return path;
}

}  // namespace

extern const PathInfo path_deferred;
const PathInfo path_deferred{.key = "deferred",
                             .summary = "G-buffer, then one full-screen pass with every light",
                             .uses_layout = true,
                             .build = build};

}  // namespace lightsweep
