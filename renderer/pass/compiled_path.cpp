#include "renderer/pass/compiled_path.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/gbuffer/layout_glsl.h"
#include "renderer/gl/context.h"
#include "shaders/shared/light_cell.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace lightsweep {
namespace {

constexpr double kMemoryShare = 0.5;  // of what is free: an image is read back and compared beside the targets

int texels(int px, const TargetDesc& target) { return (px + target.px_per_texel - 1) / target.px_per_texel; }

bool is_depth(const TargetDesc& target) { return gl::info(target.format).kind == gl::FormatKind::depth; }

// Depth or the stencil beside it.
bool changes_depth(const gl::RasterState& state) {
    const auto changes = [](const gl::StencilFace& face) {
        return face.depth_fail != gl::StencilOp::keep || face.pass != gl::StencilOp::keep;
    };
    return state.depth_write || (state.stencil_test && (changes(state.stencil_front) || changes(state.stencil_back)));
}

CompiledStage compile(const Shader& shader, const gl::RasterState& state, const SceneNeeds& needs,
                      const Layout& layout) {
    gl::ProgramDesc desc{.vertex = shader.vertex + ".vert.glsl",
                         .fragment = shader.fragment + ".frag.glsl",
                         .compute = {},
                         .defines = needs.defines(),
                         .generated = {{"generated/gbuffer.glsl", layout_glsl(layout)}}};
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
    for (const auto& target : path.targets) {
        const double side = target.px_per_texel;
        needed += gl::info(target.format).bytes * static_cast<double>(width) * height / (side * side);
    }
    const double free = static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (needed > kMemoryShare * free) {
        throw EnvironmentError(fmt::format("targets of {}x{} px need {:.1f} GiB, and {:.1f} GiB are free", width,
                                           height, needed / 0x1p30, free / 0x1p30));
    }
}

}  // namespace

CompiledPath::CompiledPath(Path path, const PathSetup& setup, int width, int height)
    : path_(std::move(path)),
      depth_clear_(setup.layout.convention == DepthConvention::reversed ? 0.0F : 1.0F),
      position_error_(position_error(setup.layout)) {
    check_memory(path_, width, height);
    for (const auto& target : path_.targets) {
        textures_.emplace_back(gl::TextureDesc{.width = texels(width, target),
                                               .height = texels(height, target),
                                               .format = target.format,
                                               .label = target.name});
    }
    if (path_.light_grid) {
        light_lists_ = std::make_unique<LightListService>(*path_.light_grid, setup.light_lists, position_error_);
    }
    const Layout& layout = path_.thin_layout ? *path_.thin_layout : setup.layout;
    for (const auto& pass : path_.passes) {
        CompiledPass compiled;
        const auto add_stage = [&](const Shader& shader, const gl::RasterState& state) {
            compiled.stages.push_back(compile(shader, state, setup.needs, layout));
        };
        if (!pass.shader.vertex.empty()) add_stage(pass.shader, pass.state);
        for (const auto& stage : pass.more_stages) add_stage(stage.shader, stage.state);
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
        if (!pass.writes.empty()) compiled.framebuffer = gl::Framebuffer(colors, depth, pass.name);
        compiled_.push_back(std::move(compiled));
        pass_names_.push_back(pass.name);
    }
}

// Binds the pass's framebuffer and gives each target its starting content.
void CompiledPath::bind_and_load(size_t index, const Frame& frame) const {
    const Pass& pass = path_.passes[index];
    if (pass.writes.empty()) return;
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
    if (light_lists_) light_lists_->bind();
}

// Lists that a pass is to build are not built here.
void CompiledPath::prepare(const Frame& frame) {
    const bool in_a_pass =
        std::any_of(path_.passes.begin(), path_.passes.end(), [](const Pass& p) { return p.record == build_lists; });
    if (light_lists_ && !in_a_pass) light_lists_->build(frame, nullptr);
}

bool CompiledPath::grow_light_lists() { return light_lists_ && light_lists_->grow_if_cut_short(); }

Recorder CompiledPath::recorder(size_t index, const DrawInput& input) const {
    Recorder recorder(input, compiled_[index].stages, position_error_);
    const bool bounded = path_.light_grid && path_.light_grid->depth_bounds;
    recorder.set_light_lists(light_lists_.get(), bounded ? &texture(path_.tile_depth) : nullptr);
    if (!compiled_[index].stages.empty()) recorder.use_stage(0);
    return recorder;
}

void CompiledPath::execute(const DrawInput& input, PassTimer& timer) const {
    timer.begin_frame(path_.passes.size());
    for (size_t i = 0; i < path_.passes.size(); ++i) {
        const Pass& pass = path_.passes[i];
        gl::push_group(pass.name);
        timer.begin_pass(i);
        bind_and_load(i, input.frame);
        bind_inputs(i, input);
        Recorder recording = recorder(i, input);
        pass.record(recording);
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

// The lists' lengths, summed over the covered pixels.
uint64_t CompiledPath::listed_lights(const shared::FrameData& data) const {
    const shared::LightGridData& grid = light_lists_->grid();
    const LightLists lists = light_lists_->read();
    const auto depths = depth().read_floats(1);
    const auto width = static_cast<size_t>(depth().width());
    uint64_t sum = 0;
    for (size_t i = 0; i < depths.size(); ++i) {
        if (depths[i] == depth_clear_) continue;
        const size_t x = i % width / grid.tile_px, y = i / width / grid.tile_px;
        const uint32_t slice = shared::slice_of(grid, data.depth_scale / (depths[i] + data.depth_offset));
        sum += lists.cells[(slice * grid.tiles_y + y) * grid.tiles_x + x].count;
    }
    return sum;
}

uint64_t CompiledPath::count_light_evaluations(const DrawInput& input) {
    const auto& data = input.frame.data;
    uint64_t evaluations = 0;
    for (size_t i = 0; i < path_.passes.size(); ++i) {
        const Pass& pass = path_.passes[i];
        bind_and_load(i, input.frame);
        bind_inputs(i, input);
        Recorder recording = recorder(i, input);
        if (pass.shades != Shades::nothing) recording.count_samples();
        pass.record(recording);
        switch (pass.shades) {
            case Shades::nothing:
                break;
            case Shades::all_lights:
                evaluations += recording.samples() * data.light_count;
                break;
            case Shades::all_lights_of_covered:
                evaluations += covered_pixels() * data.light_count;
                break;
            case Shades::listed_lights_of_covered:
                evaluations += covered_pixels() * data.directional_count + listed_lights(data);
                break;
            case Shades::directional:
                evaluations += recording.samples() * data.directional_count;
                break;
            case Shades::directional_of_covered:
                evaluations += covered_pixels() * data.directional_count;
                break;
            case Shades::one_light:
                evaluations += recording.samples();
                break;
        }
    }
    return evaluations;
}

int CompiledPath::bytes_per_pixel() const {
    int bytes = 0;
    for (const auto& target : path_.targets) {
        if (target.px_per_texel == 1) bytes += gl::info(target.format).bytes;
    }
    return bytes;
}

int CompiledPath::moved_bytes_per_pixel() const {
    const auto bytes = [&](TargetId id) {
        const TargetDesc& target = path_.targets[static_cast<size_t>(id.index)];
        return target.px_per_texel == 1 ? gl::info(target.format).bytes : 0;
    };
    int moved = 0;
    for (const auto& pass : path_.passes) {
        for (const TargetId id : pass.reads) moved += bytes(id);
        bool writes_depth = changes_depth(pass.state);
        for (const auto& stage : pass.more_stages) writes_depth = writes_depth || changes_depth(stage.state);
        for (const Write& write : pass.writes) {
            const bool tested_only = is_depth(path_.targets[static_cast<size_t>(write.target.index)]) && !writes_depth;
            moved += bytes(write.target) * (write.load == Load::keep && !tested_only ? 2 : 1);
        }
    }
    return moved;
}

size_t CompiledPath::memory_bytes() const {
    size_t bytes = 0;
    for (const auto& texture : textures_) bytes += texture.size_bytes();
    if (light_lists_) bytes += light_lists_->memory_bytes();
    return bytes;
}

}  // namespace lightsweep
