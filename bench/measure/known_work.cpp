#include "bench/measure/known_work.h"

#include "bench/measure/frame_timer.h"
#include "renderer/gl/state.h"

#include <algorithm>

namespace lightsweep {
namespace {

constexpr int kIterationsUniform = 0;  // `layout(location = 0) uniform uint iterations` of the three shaders
constexpr uint32_t kVertexBatch = 3 * 4096;
constexpr uint32_t kComputeGroups = 256;
constexpr unsigned kMaxIterations = 1U << 22;  // where a device that takes no time at all stops the calibration

}  // namespace

const std::vector<WorkKind>& work_kinds() {
    using enum WorkKind::Unit;
    static const std::vector<WorkKind> kinds = {
        {"one_framebuffer", 512, 288, 1, 1, fragment},
        {"two_framebuffers", 512, 288, 2, 2, fragment},
        {"same_framebuffer", 512, 288, 1, 2, fragment},
        {"small_target", 64, 64, 1, 1, fragment},
        {"large_target", 1920, 1080, 1, 1, fragment},
        {"vertex", 64, 64, 1, 1, vertex},
        {"compute", 64, 64, 1, 1, compute},
    };
    return kinds;
}

KnownWork::KnownWork()
    : fragment_({.vertex = "paths/fullscreen.vert.glsl", .fragment = "timer/fragment_work.frag.glsl"}),
      vertex_({.vertex = "timer/vertex_work.vert.glsl", .fragment = "paths/light_volume_mark.frag.glsl"}),
      compute_({.compute = "timer/compute_work.comp.glsl"}),
      no_attributes_({}, {}, "no attributes"),
      output_(kComputeGroups * 64 * sizeof(float), "compute work"),
      calibrated_(work_kinds().size()) {
    for (const auto& kind : work_kinds()) {
        auto& textures = textures_.emplace_back();
        auto& framebuffers = framebuffers_.emplace_back();
        for (int i = 0; i < kind.framebuffers; ++i) {
            textures.emplace_back(gl::TextureDesc{
                .width = kind.width, .height = kind.height, .format = gl::Format::RGBA8, .label = "timer work"});
        }
        for (const auto& texture : textures) {
            const gl::Texture* color = &texture;
            framebuffers.emplace_back(std::span(&color, 1), nullptr, "timer work");
        }
    }
}

void KnownWork::draw(const WorkKind& kind, unsigned iterations) {
    using enum WorkKind::Unit;
    no_attributes_.bind();
    // Blended, so that no driver may drop what is drawn over (llvmpipe does so tile by tile).
    gl::apply({.blend = gl::Blend::add});
    switch (kind.unit) {
        case fragment:
            fragment_.set_uint(kIterationsUniform, iterations);
            fragment_.use();
            gl::draw_triangles(3);
            break;
        case vertex:
            vertex_.set_uint(kIterationsUniform, iterations);
            vertex_.use();
            gl::draw_triangles(kVertexBatch);
            break;
        case compute:
            compute_.set_uint(kIterationsUniform, iterations);
            compute_.use();
            output_.bind_storage(0);
            gl::dispatch(kComputeGroups, 1, 1);
            gl::memory_barrier();
            break;
    }
}

void KnownWork::issue(size_t kind_index, int amount, PassTimer& timer) {
    const WorkKind& kind = work_kinds()[kind_index];
    const auto& framebuffers = framebuffers_[kind_index];
    const auto passes = static_cast<size_t>(kind.passes);
    const unsigned iterations = calibrated_[kind_index].iterations * static_cast<unsigned>(amount);
    timer.begin_frame(passes);
    for (size_t pass = 0; pass < passes; ++pass) {
        timer.begin_pass(pass);
        framebuffers[pass % framebuffers.size()].bind();
        draw(kind, std::max(1U, iterations / static_cast<unsigned>(passes)));
        timer.end_pass(pass);
    }
    timer.end_frame();
}

int64_t KnownWork::clock_ns(size_t kind, int amount) {
    NoTimer no_timer;
    gl::finish();
    const int64_t start = now_ns();
    issue(kind, amount, no_timer);
    gl::finish();
    return now_ns() - start;
}

void KnownWork::calibrate(int64_t unit_ns) {
    for (size_t kind = 0; kind < calibrated_.size(); ++kind) {
        unsigned& iterations = calibrated_[kind].iterations;
        iterations = static_cast<unsigned>(work_kinds()[kind].passes);
        clock_ns(kind, 1);  // compiles
        const auto fastest_ns = [&] { return std::min({clock_ns(kind, 1), clock_ns(kind, 1), clock_ns(kind, 1)}); };
        // What a unit adds to the fixed cost of touching the target: else a large target's time hardly grows with it.
        const int64_t fixed = fastest_ns();
        int64_t added = 1;
        while (added < unit_ns && iterations < kMaxIterations) {
            // At most four times as much at once: the first steps are mostly noise.
            const double factor = std::clamp(static_cast<double>(unit_ns) / static_cast<double>(added), 1.3, 4.0);
            iterations = static_cast<unsigned>(iterations * factor) + 1;
            added = std::max<int64_t>(1, fastest_ns() - fixed);
        }
    }
}

}  // namespace lightsweep
