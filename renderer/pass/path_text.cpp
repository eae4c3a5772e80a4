#include "renderer/pass/path_text.h"

#include "renderer/gbuffer/layout_glsl.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

namespace lightsweep {
namespace {

template <class... Values>
void add(std::string& text, Values... values) {
    (fmt::format_to(std::back_inserter(text), "{} ", static_cast<int>(values)), ...);
}

void add_face(std::string& text, const gl::StencilFace& f) { add(text, f.compare, f.depth_fail, f.pass); }

void add_stage(std::string& text, const Shader& shader, const gl::RasterState& s) {
    text += fmt::format("\n  {} {} [{}]", shader.vertex, shader.fragment, fmt::join(shader.defines, "; "));
    for (const auto& [include, replacement] : shader.replaced) text += fmt::format(" {}={}", include, replacement);
    text += " ";
    add(text, s.depth_test, s.depth_write, s.depth_compare, s.depth_clamp, s.cull, s.mirrored, s.blend, s.color_write,
        s.scissor_test, s.stencil_test, s.stencil_reference);
    add_face(text, s.stencil_front);
    add_face(text, s.stencil_back);
}

}  // namespace

std::string path_text(const Path& path, const PathSetup& setup, int width, int height) {
    std::string text =
        fmt::format("{}x{} convention {} clears {} back faces {} lists {} guards {} compensated {}\n[{}]\n", width,
                    height, static_cast<int>(setup.layout.convention), setup.skips.has(Skip::clears),
                    setup.skips.has(Skip::backface), static_cast<int>(setup.light_lists), setup.guards,
                    setup.compensated_sums, fmt::join(setup.code().defines(), "; "));
    if (path.light_grid) add(text, path.light_grid->tile_px, path.light_grid->slices, path.light_grid->depth_bounds);
    for (const auto& target : path.targets) add(text, target.format, target.px_per_texel);
    add(text, path.hdr.index, path.display.index);
    for (const auto& pass : path.passes) {
        text += "\n" + pass.name + " ";
        for (const TargetId id : pass.reads) add(text, id.index);
        for (const Write& write : pass.writes) add(text, write.target.index, write.load);
        add(text, pass.instances, setup.skips.has(Skip::passes) ? pass.idle : Idle::never);
        add_stage(text, pass.shader, pass.state);
        for (const auto& stage : pass.more_stages) add_stage(text, stage.shader, stage.state);
    }
    const bool has_gbuffer = !setup.layout.targets.empty();
    return has_gbuffer ? text + "\n" + layout_glsl(path.thin_layout ? *path.thin_layout : setup.layout) : text;
}

}  // namespace lightsweep
