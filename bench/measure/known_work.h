// Work whose amount is known, to try timers on: each kind is one way in which a timer has been seen to lie.
#pragma once

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/pass/pass_timer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lightsweep {

struct WorkKind {
    std::string key;
    int width = 0, height = 0;  ///< of the target, px
    int framebuffers = 1;       ///< how many different ones it draws into
    int passes = 1;             ///< how many a timer sees
    enum class Unit : uint8_t { fragment, vertex, compute } unit = Unit::fragment;
};

/// One and two framebuffers, two passes into the same one, vertices alone, compute, a small and a large target.
const std::vector<WorkKind>& work_kinds();

class KnownWork {
  public:
    KnownWork();
    /// Issues `amount` units of the kind's work as the frame of a path would, telling `timer`. One unit takes about
    /// `unit_ns` by the clock with glFinish once `calibrate` has run.
    void issue(size_t kind, int amount, PassTimer& timer);
    /// Finds how much work is one unit, on this device.
    void calibrate(int64_t unit_ns);
    /// The yardstick: the steady clock with glFinish before and after.
    int64_t clock_ns(size_t kind, int amount);

  private:
    struct Calibrated {
        unsigned iterations = 1;  ///< of the inner loop, for one unit
    };
    void draw(const WorkKind& kind, unsigned iterations);

    gl::Program fragment_, vertex_, compute_;
    gl::VertexArray no_attributes_;
    gl::Buffer output_;
    std::vector<std::vector<gl::Texture>> textures_;
    std::vector<std::vector<gl::Framebuffer>> framebuffers_;
    std::vector<Calibrated> calibrated_;
};

}  // namespace lightsweep
