// Tone mapping: exposure 1, a filmic curve, sRGB encoding, 8 bits. The same for every path.
#include "renderer/pass/recorder.h"
#include "renderer/post/post.h"

namespace lightsweep {
namespace {

void append(Path& path) {
    path.display = path.add({.name = "display", .format = gl::Format::RGBA8});
    path.passes.push_back({.name = "tone_map",
                           .shader = {"paths/fullscreen", "post/tone_map"},
                           .reads = {path.hdr},
                           .writes = {{path.display, Load::discard}},
                           .record = draw_full_screen});
}

}  // namespace

const PostInfo post_tone_map{
    .key = "tone_map", .summary = "ACES fit (Narkowicz 2015) and sRGB encoding, 8 bits", .append = append};

}  // namespace lightsweep
