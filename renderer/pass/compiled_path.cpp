#include "renderer/pass/compiled_path.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/gbuffer/layout_glsl.h"
#include "renderer/gl/context.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace lightsweep {
namespace {

constexpr double kMemoryShare = 0.5;  // of what is free: an image is read back and compared beside the targets

bool is_depth(const TargetDesc& target) { return gl::info(target.format).kind == gl::FormatKind::depth; }

CompiledStage compile(const Shader& shader, const gl::RasterState& state, const PathSetup& setup) {
    gl::ProgramDesc desc{.vertex = shader.vertex + ".vert.glsl",
                         .fragment = shader.fragment + ".frag.glsl",
                         .compute = {},
                         .defines = setup.needs.defines(),
                         .generated = {{"generated/gbuffer.glsl", layout_glsl(setup.layout)}}};
    desc.generated.insert(shader.replaced.begin(), shader.replaced.end());
    desc.defines.insert(desc.defines.end(), shader.defines.begin(), shader.defines.end());
    return {gl::Program(desc), state};
}

// A software driver takes the targets from the machine's memory, and does so only when they are first written: too late
// for an error, since the system ends the process then.
void check_memory(const Path& path, int width, int height) {
    const gl::Context& context = *gl::Context::current();
    const bool over_limit = std::max(width, height) > context.limits().max_texture_size_px;
    if (!context.info().software || over_limit) return;  // a texture over the limit says so itself
    double needed = 0.0;
    for (const auto& target : path.targets) needed += gl::info(target.format).bytes;
    needed *= static_cast<double>(width) * height;
    const double free = static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (needed > kMemoryShare * free) {
        throw EnvironmentError(fmt::format("targets of {}x{} px need {:.1f} GiB, and {:.1f} GiB are free", width,
                                           height, needed / 0x1p30, free / 0x1p30));
    }
}

}  // namespace

CompiledPath::CompiledPath(Path path, const PathSetup& setup, int width, int height)
    : path_(std::move(path)), depth_clear_(setup.layout.convention == DepthConvention::reversed ? 0.0F : 1.0F) {
    check_memory(path_, width, height);
    for (const auto& target : path_.targets) {
        textures_.emplace_back(
            gl::TextureDesc{.width = width, .height = height, .format = target.format, .label = target.name});
    }
    for (const auto& pass : path_.passes) {
        CompiledPass compiled;
        compiled.stages.push_back(compile(pass.shader, pass.state, setup));
        for (const auto& stage : pass.more_stages) compiled.stages.push_back(compile(stage.shader, stage.state, setup));
        std::vector<const gl::Texture*> colors;
        const gl::Texture* depth = nullptr;
        for (const auto& write : pass.writes) {
            const auto index = static_cast<size_t>(write.target.index);
            if (is_depth(path_.targets[index])) {
                depth = &textures_[index];
            } else {
                colors.push_back(&textures_[index]);
            }
        }
        compiled.framebuffer = gl::Framebuffer(colors, depth, pass.name);
        compiled_.push_back(std::move(compiled));
        pass_names_.push_back(pass.name);
    }
}

// Binds the pass's framebuffer and gives each target its starting content.
void CompiledPath::bind_and_load(size_t index, const Frame& frame) const {
    const Pass& pass = path_.passes[index];
    const gl::Framebuffer& framebuffer = compiled_[index].framebuffer;
    framebuffer.bind();
    // Clears obey the write masks.
    if (std::any_of(pass.writes.begin(), pass.writes.end(), [](const Write& w) { return w.load == Load::clear; })) {
        gl::apply({.depth_write = true});
    }
    int color = 0;
    for (const auto& write : pass.writes) {
        const TargetDesc& target = path_.targets[static_cast<size_t>(write.target.index)];
        const int attachment = is_depth(target) ? -1 : color++;
        if (write.load == Load::discard) framebuffer.invalidate(attachment);
        if (write.load != Load::clear) continue;
        const auto& format = gl::info(target.format);
        if (format.kind == gl::FormatKind::depth) {
            format.stencil ? framebuffer.clear_depth_stencil(depth_clear_, 0) : framebuffer.clear_depth(depth_clear_);
        } else if (format.kind == gl::FormatKind::uint) {
            framebuffer.clear_color_uint(attachment, glm::uvec4(0));
        } else {
            const bool output = write.target == path_.hdr;
            framebuffer.clear_color(attachment, output ? glm::vec4(frame.data.background, 1.0F) : glm::vec4(0.0F));
        }
    }
}

void CompiledPath::bind_inputs(size_t index, const DrawInput& input) const {
    const auto& reads = path_.passes[index].reads;
    for (size_t r = 0; r < reads.size(); ++r) {
        texture(reads[r]).bind(static_cast<unsigned>(shared::kTargetUnit) + static_cast<unsigned>(r));
    }
    input.buffers.bind(input.scene);
}

void CompiledPath::execute(const DrawInput& input, PassTimer& timer) const {
    timer.begin_frame(path_.passes.size());
    for (size_t i = 0; i < path_.passes.size(); ++i) {
        const Pass& pass = path_.passes[i];
        gl::push_group(pass.name);
        timer.begin_pass(i);
        bind_and_load(i, input.frame);
        bind_inputs(i, input);
        Recorder recorder(input, compiled_[i].stages);
        recorder.use_stage(0);
        pass.record(recorder);
        timer.end_pass(i);
        gl::pop_group();
    }
    timer.end_frame();
}

uint64_t CompiledPath::covered_pixels() const {
    const auto depth_values = depth().read_floats(1);
    return static_cast<uint64_t>(
        std::count_if(depth_values.begin(), depth_values.end(), [&](float d) { return d != depth_clear_; }));
}

uint64_t CompiledPath::count_light_evaluations(const DrawInput& input) const {
    const auto& data = input.frame.data;
    uint64_t evaluations = 0;
    for (size_t i = 0; i < path_.passes.size(); ++i) {
        const Pass& pass = path_.passes[i];
        bind_and_load(i, input.frame);
        bind_inputs(i, input);
        Recorder recorder(input, compiled_[i].stages);
        if (pass.shades != Shades::nothing) recorder.count_samples();
        recorder.use_stage(0);
        pass.record(recorder);
        switch (pass.shades) {
            case Shades::nothing:
                break;
            case Shades::all_lights:
                evaluations += recorder.samples() * data.light_count;
                break;
            case Shades::all_lights_of_covered:
                evaluations += covered_pixels() * data.light_count;
                break;
            case Shades::directional_of_covered:
                evaluations += covered_pixels() * data.directional_count;
                break;
            case Shades::one_light:
                evaluations += recorder.samples();
                break;
        }
    }
    return evaluations;
}

int CompiledPath::bytes_per_pixel() const {
    int bytes = 0;
    for (const auto& target : path_.targets) bytes += gl::info(target.format).bytes;
    return bytes;
}

size_t CompiledPath::memory_bytes() const {
    size_t bytes = 0;
    for (const auto& texture : textures_) bytes += texture.size_bytes();
    return bytes;
}

}  // namespace lightsweep
