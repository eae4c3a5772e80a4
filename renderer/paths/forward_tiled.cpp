// Forward+ (Harada et al. 2012): depth first; each tile of the screen gets the lights that reach the depths it shows;
// the visible fragments are shaded with the lights of their tile.
#include "renderer/pass/path.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, depth_prepass(s, path.depth), path);
    list_lights(s, kDepthBoundedTiles, path);
    path.passes.push_back(forward_pass(path));
    return path;
}

}  // namespace

extern const PathInfo path_forward_tiled;
const PathInfo path_forward_tiled{.key = "forward_tiled",
                                  .summary = "depth first, then the lights of each screen tile, bounded by its depth",
                                  .uses_light_lists = true,
                                  .build = build};

}  // namespace lightsweep
