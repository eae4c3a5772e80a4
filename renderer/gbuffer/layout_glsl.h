// The GLSL of a layout: `write_surface` for the pass that fills the G-buffer (under GBUFFER_WRITE), `read_surface` for
// the passes that read it.
#pragma once

#include "renderer/gbuffer/layout.h"

#include <string>

namespace lightsweep {

/// Text for `#include "generated/gbuffer.glsl"`. Target i is colour output i when written, and texture unit
/// kTargetUnit + i when read.
///
///     void write_surface(Surface s);
///     Surface read_surface(vec2 frag_coord, float depth);
///
/// An encoding that looks at its neighbours wants `bool has_surface(ivec2 pixel)` defined ahead of this text.
///
/// A fixed-point channel c in [-1, 1] is stored in an unsigned format as c / 2 + 1 / 2. In a run of b bits, an unsigned
/// channel is stored as round(c (2^b - 1)); a signed one as round(c (2^(b-1) - 1)) + 2^(b-1) - 1, so that -1, 0 and 1
/// are exact.
std::string layout_glsl(const Layout& layout);

}  // namespace lightsweep
