// Light pre-pass (Engel 2009, "Light Pre-Pass", SIGGRAPH Advances in Real-Time Rendering): a G-buffer of what lights
// need alone, which is normal and roughness; one full-screen pass sums every light without its material; the geometry
// is drawn again and evaluates its materials once. The lobes of lib/brdf.glsl make the sums exact.
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

constexpr Field kFieldsForLights[] = {Field::position, Field::normal, Field::roughness, Field::model};

// One buffer for each lobe that a model of the scene has.
std::vector<TargetId> add_light_buffers(const PathSetup& s, Path& path) {
    const auto models = s.code().models;
    const auto has = [&](ShadingModel model) { return models[static_cast<size_t>(model)]; };
    std::vector<TargetId> buffers{path.add({.name = "diffuse light", .format = s.hdr})};
    if (has(ShadingModel::ggx) || has(ShadingModel::blinn_phong)) {
        buffers.push_back(path.add({.name = "specular light, f0", .format = s.hdr}));
    }
    if (has(ShadingModel::ggx)) buffers.push_back(path.add({.name = "specular light, f90", .format = s.hdr}));
    return buffers;
}

std::vector<std::string> light_defines(const PathSetup& s, const Layout& thin) {
    const auto defines = gbuffer_read_defines(thin);
    if (gl::info(s.hdr).bits[0] == 32) return defines;
    return join(defines, "LARGEST 64512.0");  // 10 bits' largest; 11 bits and half floats hold a little more
}

Path build(const PathSetup& s) {
    const Layout thin = keep_fields(s.layout, kFieldsForLights);
    Path path;
    path.thin_layout = thin;
    const auto targets = path.add(thin.targets);
    path.depth = path.add({.name = "depth", .format = s.layout.depth});
    const auto buffers = add_light_buffers(s, path);
    path.hdr = path.add({.name = "hdr", .format = s.hdr});
    draw_geometry(s, gbuffer_pass(s, targets, path.depth), path);
    path.passes.push_back(over_surfaces(s,
                                        {.name = "lights",
                                         .shader = {"paths/fullscreen", "paths/light_buffers", light_defines(s, thin)},
                                         .reads = join(targets, path.depth),
                                         .writes = all(buffers, Load::discard),
                                         .record = draw_full_screen,
                                         .shades = Shades::all_lights_of_covered},
                                        path));
    path.passes.push_back({.name = "materials",
                           .shader = {"paths/mesh", "paths/light_prepass_combine"},
                           .reads = buffers,
                           .writes = {{path.hdr, Load::clear}, {path.depth, Load::keep}},
                           .state = equal_state(),
                           .record = draw_visible_meshes});
    return path;
}

}  // namespace

extern const PathInfo path_light_prepass;
const PathInfo path_light_prepass{
    .key = "light_prepass",
    .summary = "normals first, lights into light buffers, materials in a second geometry pass",
    .uses_layout = true,
    .build = build};

}  // namespace lightsweep
