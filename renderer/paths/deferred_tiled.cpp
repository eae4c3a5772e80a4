// Tiled deferred (Lauritzen 2010): G-buffer; each tile of the screen gets the lights that reach the depths it shows;
// one full-screen pass shades each pixel with the lights of its tile.
#include "renderer/pass/path.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, gbuffer_pass(s, targets, path.depth), path);
    list_lights(s, kDepthBoundedTiles, path);
    path.passes.push_back(resolve_pass(s, targets, path));
    return path;
}

}  // namespace

extern const PathInfo path_deferred_tiled;
const PathInfo path_deferred_tiled{.key = "deferred_tiled",
                                   .summary = "G-buffer, then the lights of each screen tile, bounded by its depth",
                                   .uses_layout = true,
                                   .uses_light_lists = true,
                                   .build = build};

}  // namespace lightsweep
