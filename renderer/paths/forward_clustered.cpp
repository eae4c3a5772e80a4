// Clustered forward (Olsson, Billeter and Assarsson 2012): lights are listed for cells of the view volume, tiles cut
// into exponential slices of view distance; depth first, then the visible fragments take the lights of their cell.
#include "renderer/pass/path.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, depth_prepass(s, path.depth), path);
    list_lights(s, kClusters, path);
    path.passes.push_back(forward_pass(path));
    return path;
}

}  // namespace

extern const PathInfo path_forward_clustered;
const PathInfo path_forward_clustered{.key = "forward_clustered",
                                      .summary = "depth first, then the lights of each cell of the view volume",
                                      .uses_light_lists = true,
                                      .build = build};

}  // namespace lightsweep
