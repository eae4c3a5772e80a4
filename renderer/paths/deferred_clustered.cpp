// Clustered deferred (Olsson, Billeter and Assarsson 2012): G-buffer; lights are listed for cells of the view volume;
// one full-screen pass shades each pixel with the lights of its cell.
#include "renderer/pass/path.h"

namespace lightsweep {
namespace {

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, gbuffer_pass(s, targets, path.depth), path);
    list_lights(s, kClusters, path);
    path.passes.push_back(resolve_pass(s, targets, path));
    return path;
}

}  // namespace

extern const PathInfo path_deferred_clustered;
const PathInfo path_deferred_clustered{.key = "deferred_clustered",
                                       .summary = "G-buffer, then the lights of each cell of the view volume",
                                       .uses_layout = true,
                                       .uses_light_lists = true,
                                       .build = build};

}  // namespace lightsweep
