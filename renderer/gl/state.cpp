#include "renderer/gl/state.h"

#include <glad/gl.h>

#include <optional>

namespace lightsweep::gl {
namespace {

constexpr GLenum kCompare[] = {GL_NEVER, GL_LESS, GL_LEQUAL, GL_EQUAL, GL_GREATER, GL_GEQUAL, GL_NOTEQUAL, GL_ALWAYS};
constexpr GLenum kStencilOp[] = {GL_KEEP, GL_ZERO, GL_INCR_WRAP, GL_DECR_WRAP, GL_REPLACE};

std::optional<RasterState> current;

void enable(GLenum what, bool on) { on ? glEnable(what) : glDisable(what); }

void set_cull(Cull cull) {
    enable(GL_CULL_FACE, cull != Cull::none);
    if (cull != Cull::none) glCullFace(cull == Cull::back ? GL_BACK : GL_FRONT);
}

void set_stencil(GLenum face, const StencilFace& s, uint8_t reference) {
    glStencilFuncSeparate(face, kCompare[static_cast<int>(s.compare)], reference, 0xFF);
    glStencilOpSeparate(face, GL_KEEP, kStencilOp[static_cast<int>(s.depth_fail)],
                        kStencilOp[static_cast<int>(s.pass)]);
}

}  // namespace

Compare reversed(Compare compare) {
    switch (compare) {
        case Compare::less:
            return Compare::greater;
        case Compare::less_equal:
            return Compare::greater_equal;
        case Compare::greater:
            return Compare::less;
        case Compare::greater_equal:
            return Compare::less_equal;
        default:
            return compare;
    }
}

void forget_state() { current.reset(); }

void apply(const RasterState& state) {
    const bool all = !current;
    const auto changed = [&](auto member) { return all || (*current).*member != state.*member; };
    if (changed(&RasterState::depth_test)) enable(GL_DEPTH_TEST, state.depth_test);
    if (changed(&RasterState::depth_write)) glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    if (changed(&RasterState::depth_compare)) glDepthFunc(kCompare[static_cast<int>(state.depth_compare)]);
    if (changed(&RasterState::depth_clamp)) enable(GL_DEPTH_CLAMP, state.depth_clamp);
    if (changed(&RasterState::cull)) set_cull(state.cull);
    if (changed(&RasterState::mirrored)) glFrontFace(state.mirrored ? GL_CW : GL_CCW);
    if (changed(&RasterState::blend)) {
        enable(GL_BLEND, state.blend == Blend::add);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    if (changed(&RasterState::color_write)) {
        const GLboolean on = state.color_write ? GL_TRUE : GL_FALSE;
        glColorMask(on, on, on, on);
    }
    if (changed(&RasterState::scissor_test)) enable(GL_SCISSOR_TEST, state.scissor_test);
    if (changed(&RasterState::stencil_test)) enable(GL_STENCIL_TEST, state.stencil_test);
    const bool reference = changed(&RasterState::stencil_reference);
    if (reference || changed(&RasterState::stencil_front)) {
        set_stencil(GL_FRONT, state.stencil_front, state.stencil_reference);
    }
    if (reference || changed(&RasterState::stencil_back)) {
        set_stencil(GL_BACK, state.stencil_back, state.stencil_reference);
    }
    current = state;
}

void apply_faces(Cull cull, bool mirrored) {
    RasterState state = current.value_or(RasterState{});
    state.cull = cull;
    state.mirrored = mirrored;
    apply(state);
}

void apply_stencil_reference(uint8_t reference) {
    RasterState state = current.value_or(RasterState{});
    state.stencil_reference = reference;
    apply(state);
}

void set_scissor(int x, int y, int width, int height) { glScissor(x, y, width, height); }

void set_clip_depth(ClipDepth clip) {
    glClipControl(GL_LOWER_LEFT, clip == ClipDepth::zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
}

void set_context_defaults() {
    set_clip_depth(ClipDepth::zero_to_one);
    glDisable(GL_DITHER);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    forget_state();
}

}  // namespace lightsweep::gl
