// A shading path as data: the targets it wants and an ordered list of passes, each saying what it reads, what it writes
// and how it loads it, and what it draws. Only `CompiledPath` (execute) touches GL.
#pragma once

#include "renderer/frame/light_list_service.h"
#include "renderer/frame/needs.h"
#include "renderer/gbuffer/layout.h"
#include "renderer/gl/format.h"
#include "renderer/gl/state.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

class Recorder;

struct TargetDesc {
    std::string name{};
    gl::Format format = gl::Format::RGBA8;
    int px_per_texel = 1;  ///< a texel stands for a square of this many pixels a side; 1: of the frame's size
};

struct TargetId {
    int index = -1;
    bool operator==(const TargetId&) const = default;
};

enum class Load : uint8_t {
    discard,  ///< every texel is overwritten, or nothing reads those that are not
    clear,    ///< to zero; a depth target to its far end, its stencil to zero; the HDR output to the background
    keep,
};

struct Write {
    TargetId target;
    Load load = Load::keep;
};

struct Shader {
    std::string vertex{}, fragment{};    ///< below shaders/, without `.vert.glsl` and `.frag.glsl`
    std::vector<std::string> defines{};  ///< besides those of the scene's needs
    /// Text that stands for an include ("lib/brdf.glsl"): the harness plants faults this way, to see that they are
    /// found.
    std::map<std::string, std::string> replaced{};
};

/// How many light evaluations one of a pass's shaded fragments makes: for the report's `work`.
enum class Shades : uint8_t {
    nothing,
    all_lights,                ///< per fragment that passes its tests
    all_lights_of_covered,     ///< per pixel that a surface covers (full-screen passes)
    listed_lights_of_covered,  ///< directional lights, and those listed for the pixel's cell
    directional,               ///< per fragment that passes its tests
    directional_of_covered,
    one_light,  ///< per fragment of the pass's last stage
};

/// A shader with its state; a pass has one, or several that its `record` switches between.
struct Stage {
    Shader shader{};
    gl::RasterState state{};
};

/// When a frame leaves a pass nothing to do, so that Skip::passes leaves the pass out. Of passes that keep all they
/// write, or whose targets nobody reads then.
enum class Idle : uint8_t {
    never,
    without_local_lights,  ///< no point or spot in the frame
    without_instances,     ///< nothing to draw of Pass::instances
    without_occlusion,     ///< the occlusion culler rests
};

struct Pass {
    std::string name{};  ///< the key of its time in the report
    Shader shader{};
    std::vector<TargetId> reads{};  ///< texture units kTargetUnit + i
    std::vector<Write> writes{};    ///< colour targets in the order of the shader's outputs; a depth target anywhere
    gl::RasterState state{};
    void (*record)(Recorder&) = nullptr;
    Shades shades = Shades::nothing;
    Instances instances = Instances::visible;  ///< what the recorder's meshes are
    Idle idle = Idle::never;
    std::vector<Stage> more_stages{};  ///< stage 0 is `shader` with `state`
};

struct Path {
    std::vector<TargetDesc> targets;
    std::vector<Pass> passes;
    TargetId depth;    ///< which pixels a surface covers
    TargetId hdr;      ///< the lit image
    TargetId display;  ///< after post effects, 8 bits, sRGB-encoded
    /// The grid whose cells get light lists, for shaders with LIGHT_GRID; see list_lights.
    std::optional<LightGridDesc> light_grid{};
    TargetId tile_depth{};  ///< of a grid with depth bounds: RG32F, a texel a tile
    /// Of a path that leaves out hidden instances: RG32F, a texel for each tile of OcclusionCuller; see draw_geometry.
    TargetId occluder_depth{};
    /// What its G-buffer stores, where that is less than the setup's layout.
    std::optional<Layout> thin_layout{};

    TargetId add(TargetDesc target) {
        targets.push_back(std::move(target));
        return {static_cast<int>(targets.size()) - 1};
    }
    /// Adds the layout's colour targets, in their order.
    std::vector<TargetId> add(const std::vector<LayoutTarget>& layout_targets);
};

/// What a path is built from.
struct PathSetup {
    SceneNeeds needs;
    Layout layout;  ///< what is left after drop_unneeded; paths without a layout use its depth alone
    gl::Format hdr = gl::Format::RGBA16F;
    ListBuilder light_lists = ListBuilder::cpu;  ///< of paths that list lights
    SkipSet skips = SkipSet::all();
    bool guards = true;             ///< shaders guard what may divide by zero, overflow or lose all digits
    bool compensated_sums = false;  ///< lights are summed with what each addition rounds off carried along

    /// What shaders are compiled for.
    SceneNeeds code() const { return skips.has(Skip::code) ? needs : needs.with_all_code(); }
};

struct PathInfo {
    std::string_view key;
    std::string_view summary;
    bool uses_layout = false;
    bool uses_light_lists = false;
    Path (*build)(const PathSetup&) = nullptr;
};

/// `targets` written with one way of loading.
std::vector<Write> all(const std::vector<TargetId>& targets, Load load);
std::vector<TargetId> join(std::vector<TargetId> targets, TargetId one_more);
std::vector<Write> join(std::vector<Write> writes, Write one_more);
std::vector<std::string> join(std::vector<std::string> defines, std::string one_more);

/// Depth test and write for opaque geometry: nearer wins, in either convention.
gl::RasterState opaque_state(DepthConvention convention);
/// The same, but only the surface that a prepass left: equal, and no write.
gl::RasterState equal_state();

/// A full-screen pass for the path's surfaces. With Skip::background the depth test keeps it from all other pixels,
/// which stay as they were loaded: an HDR output is cleared. Otherwise its shader has MAY_BE_BACKGROUND and sees to
/// them.
Pass over_surfaces(const PathSetup& setup, Pass pass, const Path& path);

/// Adds a pass that fills `path.depth` by drawing the visible meshes, and maybe other targets with it. With
/// Skip::occlusion it draws those seen before, is followed by passes that find what they hide, and by itself for the
/// rest.
void draw_geometry(const PathSetup& setup, Pass pass, Path& path);

/// Gives the path a light grid and adds the passes that list its lights, after those that fill `path.depth`: the depth
/// range of each tile when the grid has depth bounds, and the lists, unless the CPU can build them before the frame.
/// Without Skip::light_lists the path gets none; without Skip::light_depth the grid has no depth bounds.
void list_lights(const PathSetup& setup, LightGridDesc grid, Path& path);
/// Cells for list_lights: small tiles that end where their surfaces do, or larger ones cut into slices.
inline constexpr LightGridDesc kDepthBoundedTiles{.tile_px = 16, .depth_bounds = true};
inline constexpr LightGridDesc kClusters{.tile_px = 32, .slices = true};

/// The pass that leaves the depth of what is visible, for passes with equal_state.
Pass depth_prepass(const PathSetup& setup, TargetId depth);

/// The pass that fills the layout's targets and the depth with what is visible.
Pass gbuffer_pass(const PathSetup& setup, const std::vector<TargetId>& targets, TargetId depth);

/// The pass that shades what a prepass left visible with every light of LIGHT_GRID where the path has one, else of the
/// frame.
Pass forward_pass(const Path& path);

/// The full-screen pass that shades the layout's surfaces, with lights as `forward_pass`.
Pass resolve_pass(const PathSetup& setup, const std::vector<TargetId>& targets, const Path& path);

/// The full-screen pass that shades what no light's bounds hold: emission, ambient, directional lights, background.
/// Reads the layout's targets.
Pass base_pass(const PathSetup& setup, const std::vector<TargetId>& targets, const Path& path);

/// Whether a pass for that is to be there: scenes without (SceneNeeds::base) need none with Skip::passes.
bool draws_base(const PathSetup& setup);
/// A pass that adds point and spot lights to what the base pass left in the HDR target; where there is no base pass, to
/// black.
Pass adding_lights(const PathSetup& setup, Pass pass, const Path& path);

/// The defines that lib/gbuffer_pixel.glsl wants when a pass reads the layout's targets and then the depth.
std::vector<std::string> gbuffer_read_defines(const Layout& layout);

}  // namespace lightsweep
