#include "bench/measure/rounding_probe.h"

#include "bench/plan/cell.h"
#include "bench/report/json_codec.h"
#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/state.h"
#include "renderer/image/image.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lightsweep {
namespace {

constexpr int kValueUniform = 0;  // `layout(location = 0) uniform float value`
constexpr int kTenths = 4000;
constexpr double kSureStep = 0.05;  // what is read back is this near a step at most

bool is_float(gl::Format format) { return gl::info(format).kind == gl::FormatKind::floating; }

std::string small_name(gl::Format format) {
    std::string name(gl::info(format).name);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name;
}

// The steps of a format's red channel, counted from one in the middle of its range (even, where ties matter).
class Steps {
  public:
    explicit Steps(gl::Format format) : format_(format) {
        const auto& info = gl::info(format);
        if (is_float(format)) {
            size_ = std::ldexp(1.0, -mantissa_bits(info.bits[0]));
            zero_ = 1.0;
        } else {
            const int bits = info.bits[0] - (info.kind == gl::FormatKind::snorm ? 1 : 0);
            size_ = 1.0 / (std::ldexp(1.0, bits) - 1.0);
            zero_ = size_ * std::ldexp(1.0, bits - 1);
        }
    }
    /// What a shader writes to be `steps` above; sRGB formats encode it.
    double value(double steps) const {
        const double stored = zero_ + steps * size_;
        return format_ == gl::Format::SRGB8_A8 ? srgb_to_linear(static_cast<float>(stored)) : stored;
    }
    /// The step that is stored; nothing where it is none.
    std::optional<int> step(float stored) const {
        const double steps = (double{stored} - zero_) / size_;
        const double whole = std::round(steps);
        if (!(std::abs(steps - whole) < kSureStep && std::abs(whole) < 4.0)) return std::nullopt;
        return static_cast<int>(whole);
    }

  private:
    gl::Format format_;
    double size_, zero_;
};

class Target {
  public:
    explicit Target(gl::Format format)
        : program_({.vertex = "paths/fullscreen.vert.glsl", .fragment = "timer/constant.frag.glsl"}),
          empty_({}, {}, "no attributes"),
          texture_({.width = 1, .height = 1, .format = format, .label = "rounding probe"}) {
        const gl::Texture* color = &texture_;
        framebuffer_ = gl::Framebuffer(std::span(&color, 1), nullptr, "rounding probe");
    }
    float written(double value) { return result(0.0F, value, 1, gl::Blend::none); }
    // Starts at `start`, then adds `value` `times` times.
    float blended(double start, double value, int times) { return result(start, value, times, gl::Blend::add); }

  private:
    float result(double start, double value, int times, gl::Blend blend) {
        framebuffer_.bind();
        gl::RasterState state;
        gl::apply(state);
        framebuffer_.clear_color(0, glm::vec4(static_cast<float>(start)));
        state.blend = blend;
        gl::apply(state);
        empty_.bind();
        program_.set_float(kValueUniform, static_cast<float>(value));
        program_.use();
        for (int i = 0; i < times; ++i) gl::draw_triangles(3);
        return texture_.read_floats(1).front();
    }

    gl::Program program_;
    gl::VertexArray empty_;
    gl::Texture texture_;
    gl::Framebuffer framebuffer_;
};

// From what became of a quarter and of three quarters of a step.
Rounding judge(std::optional<int> quarter, std::optional<int> three_quarters) {
    if (quarter == 0 && three_quarters == 1) return Rounding::nearest;
    return quarter == 0 && three_quarters == 0 ? Rounding::truncate : Rounding::other;
}

// From what became of 1/2, whose lower neighbour is even, and of 3/2, whose upper one is.
Ties judge_ties(std::optional<int> half, std::optional<int> three_halves) {
    if (half == 0 && three_halves == 2) return Ties::to_even;
    if (half == 1 && three_halves == 2) return Ties::up;
    return half == 0 && three_halves == 1 ? Ties::down : Ties::other;
}

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

std::string word(Ties ties) {
    switch (ties) {
        case Ties::to_even:
            return "to even";
        case Ties::up:
            return "up";
        case Ties::down:
            return "down";
        case Ties::other:
            break;
    }
    return "other";
}

int mantissa_bits(int stored_bits) {
    switch (stored_bits) {
        case 32:
            return 23;
        case 16:
            return 10;
        case 11:
            return 6;
        case 10:
            return 5;
        default:
            break;
    }
    CHECK_THAT(false, "no float of {} bits", stored_bits);
}

RoundingProbe probe_rounding(gl::Format format) {
    const auto kind = gl::info(format).kind;
    CHECK_THAT(kind != gl::FormatKind::uint && kind != gl::FormatKind::depth, "{}", gl::info(format).name);
    RoundingProbe probe{.format = small_name(format)};
    try {
        Target target(format);
        const Steps steps(format);
        const auto written = [&](double value) { return steps.step(target.written(steps.value(value))); };
        const auto blended = [&](double value) {
            return steps.step(target.blended(steps.value(0.0), steps.value(value) - steps.value(0.0), 1));
        };
        if (is_float(format) && gl::info(format).bits[0] == 32) {
            probe.write = Rounding::nearest;  // nothing is rounded: shaders compute in these
        } else {
            probe.write = judge(written(0.25), written(0.75));
            if (is_float(format) && probe.write == Rounding::nearest) {
                probe.ties = judge_ties(written(0.5), written(1.5));
            }
        }
        probe.blend = judge(blended(0.25), blended(0.75));
        if (std::ranges::find(kHdrFormats, probe.format) != kHdrFormats.end()) {
            probe.sum_of_tenths = target.blended(0.0, 0.1, kTenths);
        }
    } catch (const EnvironmentError&) {
        // The device does not draw to this format.
    }
    return probe;
}

std::vector<RoundingProbe> probe_rounding() {
    std::vector<RoundingProbe> probes;
    for (size_t i = 0; i < gl::format_names().size(); ++i) {
        const auto format = static_cast<gl::Format>(i);
        const auto kind = gl::info(format).kind;
        if (kind != gl::FormatKind::uint && kind != gl::FormatKind::depth) probes.push_back(probe_rounding(format));
    }
    return probes;
}

Json to_json(const std::vector<RoundingProbe>& probes) {
    const auto word_or_null = [](const auto& found) { return found ? Json(word(*found)) : Json(nullptr); };
    Json list = Json::array();
    for (const RoundingProbe& probe : probes) {
        list.push_back({{"format", probe.format},
                        {"write", word_or_null(probe.write)},
                        {"ties", word_or_null(probe.ties)},
                        {"blend", word_or_null(probe.blend)},
                        {"sum_of_4000_tenths", codec::encode(probe.sum_of_tenths)}});
    }
    return list;
}

}  // namespace lightsweep
