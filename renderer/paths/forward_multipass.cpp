// Forward with a pass for each light, as before shaders could loop: what no light brings first, with the depth; then
// each point or spot light is added by drawing again what its bounds touch, inside the rectangle that holds them.
// Surfaces at exactly the same place are lit once for each of them: equal depth cannot tell them apart.
// The draws go by batch and not by light: sums do not mind, and each material is bound once.
#include "renderer/frame/light_draws.h"
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

namespace lightsweep {
namespace {

gl::RasterState light_state() {
    gl::RasterState state = equal_state();
    state.scissor_test = true;
    return state;
}

void draw_lights(Recorder& recorder) {
    const Frame& frame = recorder.frame();
    const auto bounds = recorder.light_bounds();
    std::vector<PixelRect> rects;
    rects.reserve(bounds.size());
    for (const auto& light : bounds) rects.push_back(screen_rect(light, frame.setup));

    const LightDraws lit = make_light_draws(recorder.scene(), frame, recorder.drawn(), bounds);
    recorder.bind_instances(lit.instances);
    const LightDraw* previous = nullptr;
    for (const LightDraw& item : lit.draws) {
        const PixelRect& rect = rects[item.light - frame.data.directional_count];
        if (rect.empty()) continue;
        if (previous == nullptr || previous->draw.batch != item.draw.batch) recorder.bind_batch(item.draw.batch);
        recorder.set_scissor(rect);
        recorder.draw_light_instances(item.light, item.draw);
        previous = &item;
    }
}

Path build(const PathSetup& s) {
    Path path;
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    if (draws_base(s)) {
        draw_geometry(s,
                      {.name = "base",
                       .shader = {"paths/mesh", "paths/forward_base"},
                       .writes = {{path.hdr, Load::clear}, {path.depth, Load::clear}},
                       .state = opaque_state(s.layout.convention),
                       .record = draw_visible_meshes,
                       .shades = Shades::directional},
                      path);
    } else {
        draw_geometry(s, depth_prepass(s, path.depth), path);
    }
    path.passes.push_back(adding_lights(s,
                                        {.name = "lights",
                                         .shader = {"paths/mesh", "paths/forward_light"},
                                         .writes = {{path.hdr, Load::keep}, {path.depth, Load::keep}},
                                         .state = light_state(),
                                         .record = draw_lights,
                                         .shades = Shades::one_light},
                                        path));
    return path;
}

}  // namespace

extern const PathInfo path_forward_multipass;
const PathInfo path_forward_multipass{
    .key = "forward_multipass", .summary = "one additive pass for each light over what it touches", .build = build};

}  // namespace lightsweep
