#include "renderer/paths/view.h"

#include "renderer/base/check.h"
#include "renderer/pass/recorder.h"

#include <algorithm>
#include <cctype>

namespace lightsweep {

const std::vector<std::string>& view_names() {
    static const std::vector<std::string> names = {"final",    "depth",    "normal",    "base_color", "roughness",
                                                   "metallic", "position", "luminance", "lights",     "material"};
    return names;
}

Path build_view(const std::string& view, const PathSetup& s) {
    CHECK(view != "final");
    std::string define = "VIEW_" + view;
    std::transform(define.begin(), define.end(), define.begin(), [](unsigned char c) { return std::toupper(c); });

    Path path;
    const auto targets = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    path.hdr = path.add({.name = "view values", .format = gl::Format::RGBA32F});
    path.display = path.add({.name = "display", .format = gl::Format::RGBA8});
    if (view == "material") {  // no layout stores it
        path.passes = {{.name = "view",
                        .shader = {"paths/mesh", "paths/view_material"},
                        .writes = {{path.hdr, Load::clear}, {path.display, Load::clear}, {path.depth, Load::clear}},
                        .state = opaque_state(s.layout.convention),
                        .record = draw_visible_meshes}};
        return path;
    }
    auto defines = gbuffer_read_defines(s.layout);
    defines.push_back(define);
    path.passes = {
        gbuffer_pass(s, targets, path.depth),
        {.name = "view",
         .shader = {"paths/fullscreen", "paths/view", defines},
         .reads = join(targets, path.depth),
         .writes = {{path.hdr, Load::discard}, {path.display, Load::discard}},
         .record = draw_full_screen},
    };
    return path;
}

}  // namespace lightsweep
