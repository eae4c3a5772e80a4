// Shader text: stage files from shaders/ with their includes, defines and generated parts put together, and the way
// back from a driver's log to the original file and line. Text only, no GL.
#pragma once

#include "renderer/base/resources.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep::gl {

/// Where a line of the assembled text came from.
struct LineOrigin {
    size_t file = 0;  ///< index into ShaderSource::files
    size_t line = 0;  ///< from 1
};

struct ShaderSource {
    std::string text;  ///< ready for the compiler
    /// 0 is the list of defines, 1 the stage file, the rest its includes in the order met ("shaders/lib/brdf.glsl",
    /// "generated/gbuffer.glsl").
    std::vector<std::string> files;
    /// One for each line of `text`. Not told to the compiler by #line: Mesa forgets the source string's number.
    std::vector<LineOrigin> origins;
};

/// The stage file `name` ("paths/forward.frag.glsl") of the folder `root`, preceded by `#version 450 core` (so the file
/// has no #version of its own) and by `#define ` + each of `defines` ("NAME" or "NAME value").
/// `#include "lib/x.glsl"` is relative to `root` wherever it stands, and is expanded once per shader. A key of
/// `generated` stands for its text, ahead of any file of that name. Comments are left out, and
/// so is `#include <x>` under an #if, which is C++'s.
/// Throws InputError: a file that is missing (with the including file and line), a malformed include, a #version or
/// #line in a file, and an include of a file that came in under an #if before (the loader does not evaluate conditions,
/// so the text might be missing).
ShaderSource load_shader(std::string_view name, std::span<const std::string> defines = {},
                         const std::map<std::string, std::string>& generated = {},
                         const std::filesystem::path& root = resource("shaders"));

/// The log of a driver that was given `source.text` as its only source string, with `shaders/lib/x.glsl:12:` in the
/// places where it says `0:70(5):` (Mesa), `0(70) :` (NVIDIA) or `ERROR: 0:70:` (others). Other lines stay as they are.
std::string map_log(const std::string& log, const ShaderSource& source);

}  // namespace lightsweep::gl
