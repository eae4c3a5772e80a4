// The fixed-function state of a draw, as data. `apply` sets all of it, skipping what is set already.
#pragma once

#include <cstdint>

namespace lightsweep::gl {

enum class Compare : uint8_t { never, less, less_equal, equal, greater, greater_equal, not_equal, always };
enum class Cull : uint8_t { none, back, front };
enum class Blend : uint8_t {
    none,
    add,  ///< destination + source, all channels
};
enum class StencilOp : uint8_t { keep, zero, increment_wrap, decrement_wrap, replace };

struct StencilFace {
    Compare compare = Compare::always;  ///< of the reference (stencil_reference) against the stored value
    StencilOp depth_fail = StencilOp::keep;
    StencilOp pass = StencilOp::keep;
    bool operator==(const StencilFace&) const = default;
};

struct RasterState {
    bool depth_test = false;
    bool depth_write = false;
    Compare depth_compare = Compare::less;
    bool depth_clamp = false;  ///< geometry before near or past far is kept, its depth clamped
    Cull cull = Cull::none;
    bool mirrored = false;  ///< clockwise triangles are the front ones
    Blend blend = Blend::none;
    bool color_write = true;
    bool scissor_test = false;  ///< only pixels of set_scissor's rectangle
    bool stencil_test = false;
    uint8_t stencil_reference = 0;
    StencilFace stencil_front{};
    StencilFace stencil_back{};
    bool operator==(const RasterState&) const = default;
};

/// The same comparison for the opposite depth convention (less <-> greater).
Compare reversed(Compare compare);

/// Forgets what is set; call it when the current context changed.
void forget_state();
void apply(const RasterState& state);
/// Changes only which side of triangles is drawn, and which is the front, of the state that is set.
void apply_faces(Cull cull, bool mirrored);

/// Changes only the stencil's reference of the state that is set.
void apply_stencil_reference(uint8_t reference);
/// The rectangle of RasterState::scissor_test: lower left corner and size in pixels.
void set_scissor(int x, int y, int width, int height);

/// Which z / w the near and far planes have before the viewport maps them to a depth of [0, 1].
enum class ClipDepth : uint8_t {
    zero_to_one,       ///< as every path expects: the viewport leaves the number alone, and small ones keep their bits
    minus_one_to_one,  ///< GL's own, without glClipControl: / 2 + 1 / 2 rounds small numbers away
};
void set_clip_depth(ClipDepth clip);

/// Once per context: zero-to-one clip depth, lower-left origin, no dithering, sRGB formats encoded when written.
void set_context_defaults();

}  // namespace lightsweep::gl
