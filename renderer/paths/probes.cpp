#include "renderer/paths/probes.h"

#include "renderer/pass/recorder.h"

namespace lightsweep {

VisibleTrianglePath build_visible_triangles(const PathSetup& s) {
    VisibleTrianglePath result;
    Path& path = result.path;
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    result.triangles = path.add({.name = "visible triangles", .format = gl::Format::RG32UI});
    std::vector<TargetId> colors{result.triangles};
    std::vector<std::string> defines{"DEPTH_ONLY", "OUTPUT_INSTANCE"};
    if (s.needs.textures()) {
        result.base_color_roughness = path.add({.name = "base colour, roughness", .format = gl::Format::RGBA32F});
        result.normal_metallic = path.add({.name = "normal, metallic", .format = gl::Format::RGBA32F});
        result.emissive = path.add({.name = "emissive", .format = gl::Format::RGBA32F});
        colors.insert(colors.end(), {result.base_color_roughness, result.normal_metallic, result.emissive});
        defines.emplace_back("OUTPUT_TEXELS");
    }
    path.passes = {{.name = "visible triangles",
                    .shader = {"paths/mesh", "paths/visible_triangle", defines},
                    .writes = join(all(colors, Load::clear), {path.depth, Load::clear}),
                    .state = opaque_state(s.layout.convention),
                    .record = draw_visible_meshes}};
    return result;
}

DecodedSurfacePath build_decoded_surface(const PathSetup& s) {
    DecodedSurfacePath result;
    Path& path = result.path;
    const auto gbuffer = path.add(s.layout.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    const auto add = [&](const char* name) { return path.add({.name = name, .format = gl::Format::RGBA32F}); };
    result.position_roughness = add("position, roughness");
    result.normal_metallic = add("normal, metallic");
    result.base_color_covered = add("base colour, covered");
    result.specular = add("specular");
    result.emissive = add("emissive");
    path.passes = {
        gbuffer_pass(s, gbuffer, path.depth),
        {.name = "decode",
         .shader = {"paths/fullscreen", "paths/decoded_surface", gbuffer_read_defines(s.layout)},
         .reads = join(gbuffer, path.depth),
         .writes = all({result.position_roughness, result.normal_metallic, result.base_color_covered, result.specular,
                        result.emissive},
                       Load::discard),
         .record = draw_full_screen},
    };
    return result;
}

}  // namespace lightsweep
