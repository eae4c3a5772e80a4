#include "bench/measure/rounding_probe.h"

#include "bench/measure/arm.h"
#include "bench/plan/cell.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/state.h"

#include <cmath>

namespace lightsweep {
namespace {

constexpr int kValueUniform = 0;  // `layout(location = 0) uniform float value`

// The distance from 1 to the next number of the format's red channel: 2^-mantissa bits.
float ulp_of_one(gl::Format format) {
    switch (format) {
        case gl::Format::RGBA16F:
            return 0x1p-10F;
        case gl::Format::R11G11B10F:
            return 0x1p-6F;
        default:
            return 0x1p-23F;
    }
}

// What became of 1 + 3/4 ulp.
Rounding judge(float stored, float ulp) {
    if (stored == 1.0F + ulp) return Rounding::nearest;
    return stored == 1.0F ? Rounding::truncate : Rounding::other;
}

class Probe {
  public:
    explicit Probe(gl::Format format)
        : program_({.vertex = "paths/fullscreen.vert.glsl", .fragment = "timer/constant.frag.glsl"}),
          empty_({}, {}, "no attributes"),
          texture_({.width = 1, .height = 1, .format = format, .label = "rounding probe"}) {
        const gl::Texture* color = &texture_;
        framebuffer_ = gl::Framebuffer(std::span(&color, 1), nullptr, "rounding probe");
    }
    // Starts at `start`, then draws `value` `times` times; with blending, or overwriting.
    float result(float start, float value, int times, bool blend) {
        framebuffer_.bind();
        gl::RasterState state;
        gl::apply(state);
        framebuffer_.clear_color(0, glm::vec4(start));
        state.blend = blend ? gl::Blend::add : gl::Blend::none;
        gl::apply(state);
        empty_.bind();
        program_.set_float(kValueUniform, value);
        program_.use();
        for (int i = 0; i < times; ++i) gl::draw_triangles(3);
        return texture_.read_floats(1).front();
    }

  private:
    gl::Program program_;
    gl::VertexArray empty_;
    gl::Texture texture_;
    gl::Framebuffer framebuffer_;
};

}  // namespace

std::string word(Rounding rounding) {
    switch (rounding) {
        case Rounding::nearest:
            return "nearest";
        case Rounding::truncate:
            return "truncates";
        case Rounding::other:
            break;
    }
    return "other";
}

std::vector<RoundingProbe> probe_rounding() {
    std::vector<RoundingProbe> probes;
    for (const auto& name : kHdrFormats) {
        const gl::Format format = hdr_format(name);
        const float ulp = ulp_of_one(format);
        Probe probe(format);
        // In 32 bits the sum 1 + 3/4 ulp is rounded before it is stored: only the blending is seen there.
        const bool wide = format == gl::Format::RGBA32F;
        probes.push_back(
            {.format = name,
             .write = wide ? Rounding::nearest : judge(probe.result(0.0F, 1.0F + 0.75F * ulp, 1, false), ulp),
             .blend = judge(probe.result(1.0F, 0.75F * ulp, 1, true), ulp),
             .sum_of_4000_tenths = static_cast<double>(probe.result(0.0F, 0.1F, 4000, true))});
    }
    return probes;
}

}  // namespace lightsweep
