#include "renderer/gl/workarounds.h"

#include "renderer/gl/context.h"

namespace lightsweep::gl {
namespace {

bool is_mesa(const ContextInfo& info) { return info.version.find("Mesa") != std::string::npos; }
bool is_llvmpipe(const ContextInfo& info) { return info.renderer.find("llvmpipe") != std::string::npos; }

const Workaround kWorkarounds[] = {
    {"mesa_release_before_switch",
     "Mesa's EGL and OSMesa keep the thread's dispatch table in common, but each remembers its own current context. "
     "When "
     "one takes the thread while the other still holds it, the return to the first is taken for a change to what is "
     "current already, and its calls go to the other's objects: reading an EGL texture gives OSMesa's pixels. "
     "Acted on: Context::make_current() releases the current context before it makes another one current.",
     is_mesa},
    {"mesa_log_without_source",
     "The compiler's log gives source string 0 for most errors whatever #line said, so that an error in an include "
     "names "
     "the wrong file. Acted on: shader_source.cpp emits no #line and maps the lines of the whole text back by a table.",
     is_mesa},
    {"osmesa_no_debug_flag",
     "OSMesa cannot be asked for a debug context, and outside of one a driver starts with debug output off. "
     "Acted on: Context turns GL_DEBUG_OUTPUT on itself in every context; llvmpipe then reports errors all the same.",
     [](const ContextInfo& info) { return info.provider == "osmesa"; }},
    {"llvmpipe_pow_zero",
     "pow(0, 0) is 0 (GLSL leaves it undefined; many GPUs give 1 or NaN). "
     "Acted on: shaders/lib/brdf.glsl raises to a power with exp2 and log2 of a base that is kept above 0.",
     is_llvmpipe},
    {"llvmpipe_query_last_tile",
     "Timer queries keep the last 64x64 tile of a framebuffer only, and leave vertex and compute work out, although "
     "GL_QUERY_COUNTER_BITS says 64. Only reported: the timer is chosen by its self-test, whatever the driver's name.",
     is_llvmpipe},
    {"llvmpipe_blend_truncates",
     "Blending into a float target truncates where GPUs usually round to nearest: 4000 times 0.1 added in half "
     "precision "
     "gives 128, rounding gives 256. Only reported: the HDR target's format is an option of every cell (hdr=rgba32f), "
     "so "
     "that this loss can be told from that of a path or a layout.",
     is_llvmpipe},
    {"llvmpipe_flushes_denormals",
     "Denormal results become 0 in shaders. Only reported: the encodings' bounds do not count on denormals.",
     is_llvmpipe},
};

}  // namespace

std::span<const Workaround> all_workarounds() { return kWorkarounds; }

std::vector<std::string> active_workarounds(const ContextInfo& info) {
    std::vector<std::string> keys;
    for (const Workaround& workaround : kWorkarounds)
        if (workaround.applies(info)) keys.emplace_back(workaround.key);
    return keys;
}

}  // namespace lightsweep::gl
