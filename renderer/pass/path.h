// A shading path as data: the targets it wants and an ordered list of passes, each saying what it reads, what it writes
// and how it loads it, and what it draws. Only `CompiledPath` (execute) touches GL.
#pragma once

#include "renderer/frame/needs.h"
#include "renderer/gbuffer/layout.h"
#include "renderer/gl/format.h"
#include "renderer/gl/state.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

class Recorder;

struct TargetDesc {
    std::string name{};
    gl::Format format = gl::Format::RGBA8;  ///< always of the frame's size
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
    all_lights,             ///< per fragment that passes its tests
    all_lights_of_covered,  ///< per pixel that a surface covers (full-screen passes)
    directional_of_covered,
    one_light,  ///< per fragment of the pass's last stage
};

/// A shader with its state; a pass has one, or several that its `record` switches between.
struct Stage {
    Shader shader{};
    gl::RasterState state{};
};

struct Pass {
    std::string name{};  ///< the key of its time in the report
    Shader shader{};
    std::vector<TargetId> reads{};  ///< texture units kTargetUnit + i
    std::vector<Write> writes{};    ///< colour targets in the order of the shader's outputs; a depth target anywhere
    gl::RasterState state{};
    void (*record)(Recorder&) = nullptr;
    Shades shades = Shades::nothing;
    std::vector<Stage> more_stages{};  ///< stage 0 is `shader` with `state`
};

struct Path {
    std::vector<TargetDesc> targets;
    std::vector<Pass> passes;
    TargetId depth;    ///< which pixels a surface covers
    TargetId hdr;      ///< the lit image
    TargetId display;  ///< after post effects, 8 bits, sRGB-encoded

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
};

struct PathInfo {
    std::string_view key;
    std::string_view summary;
    bool uses_layout = false;
    Path (*build)(const PathSetup&) = nullptr;
};

/// `targets` written with one way of loading.
std::vector<Write> all(const std::vector<TargetId>& targets, Load load);
std::vector<TargetId> join(std::vector<TargetId> targets, TargetId one_more);
std::vector<Write> join(std::vector<Write> writes, Write one_more);

/// Depth test and write for opaque geometry: nearer wins, in either convention.
gl::RasterState opaque_state(DepthConvention convention);
/// The same, but only the surface that a prepass left: equal, and no write.
gl::RasterState equal_state();

/// The pass that fills the layout's targets and the depth with what is visible.
Pass gbuffer_pass(const PathSetup& setup, const std::vector<TargetId>& targets, TargetId depth);

/// The defines that lib/gbuffer_pixel.glsl wants when a pass reads the layout's targets and then the depth.
std::vector<std::string> gbuffer_read_defines(const Layout& layout);

}  // namespace lightsweep
