// Deferred with rectangles: each point or spot light shades the rectangle of the screen that holds its bounds, under a
// scissor test. What no bounds hold is shaded full-screen first.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

namespace lightsweep {
namespace {

void draw_lights(Recorder& recorder) {
    recorder.bind_full_screen();
    uint32_t light = recorder.frame().data.directional_count;
    for (const auto& bounds : recorder.light_bounds()) {
        const PixelRect rect = screen_rect(bounds, recorder.frame().setup);
        if (!rect.empty()) {
            recorder.set_scissor(rect);
            recorder.draw_light_screen(light);
        }
        ++light;
    }
}

Path build(const PathSetup& s) {
    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, gbuffer_pass(s, targets, path.depth), path);
    if (draws_base(s)) path.passes.push_back(base_pass(s, targets, path));
    path.passes.push_back(adding_lights(
        s,
        over_surfaces(s,
                      {.name = "lights",
                       .shader = {"paths/fullscreen", "paths/resolve_light", gbuffer_read_defines(s.layout)},
                       .reads = join(targets, path.depth),
                       .writes = {{path.hdr, Load::keep}},
                       .state = {.scissor_test = true},
                       .record = draw_lights,
                       .shades = Shades::one_light},
                      path),
        path));
    return path;
}

}  // namespace

extern const PathInfo path_deferred_scissor;
const PathInfo path_deferred_scissor{.key = "deferred_scissor",
                                     .summary = "G-buffer, then a scissored rectangle for each light",
                                     .uses_layout = true,
                                     .build = build};

}  // namespace lightsweep
