// Forward with a depth prepass: depth alone first, then only the visible surface is shaded, once.
#include "renderer/pass/path.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, depth_prepass(s, path.depth), path);
    path.passes.push_back(forward_pass(path));
    return path;
}

}  // namespace

extern const PathInfo path_forward_prepass;
const PathInfo path_forward_prepass{.key = "forward_prepass",
                                    .summary = "depth first, then every light for the visible fragments",
                                    .uses_layout = false,
                                    .build = build};

}  // namespace lightsweep
