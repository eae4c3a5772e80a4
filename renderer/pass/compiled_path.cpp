#include "renderer/pass/compiled_path.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/gbuffer/layout_glsl.h"
#include "renderer/gl/context.h"
#include "renderer/pass/path_text.h"
#include "shaders/shared/light_cell.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace lightsweep {
namespace {

constexpr size_t kFirstInstances = 4096;  // bytes; the buffers grow
constexpr double kMemoryShare = 0.5;      // of what is free: an image is read back and compared beside the targets

int texels(int px, const TargetDesc& target) { return (px + target.px_per_texel - 1) / target.px_per_texel; }

bool is_depth(const TargetDesc& target) { return gl::info(target.format).kind == gl::FormatKind::depth; }

// Depth or the stencil beside it.
bool changes_depth(const gl::RasterState& state) {
    const auto changes = [](const gl::StencilFace& face) {
        return face.depth_fail != gl::StencilOp::keep || face.pass != gl::StencilOp::keep;
    };
    return state.depth_write || (state.stencil_test && (changes(state.stencil_front) || changes(state.stencil_back)));
}

CompiledStage compile(const Shader& shader, const gl::RasterState& state, const std::vector<std::string>& defines,
                      const Layout& layout) {
    gl::ProgramDesc desc{.vertex = shader.vertex + ".vert.glsl",
                         .fragment = shader.fragment + ".frag.glsl",
                         .compute = {},
                         .defines = defines,
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
      skips_(setup.skips),
      text_(path_text(path_, setup, width, height)),
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
    if (path_.occluder_depth.index >= 0) {
        occlusion_ = std::make_unique<OcclusionCuller>();
        for (auto& buffer : occlusion_instances_) buffer = gl::Buffer(kFirstInstances, "instances of a phase");
    }
    const Layout& layout = path_.thin_layout ? *path_.thin_layout : setup.layout;
    auto defines = setup.code().defines();
    if (!skips_.has(Skip::backface)) defines.emplace_back("KEEPS_BACK_FACES");
    if (!setup.guards) defines.emplace_back("UNGUARDED");
    if (setup.compensated_sums) defines.emplace_back("COMPENSATED_SUMS");
    for (const auto& pass : path_.passes) {
        CompiledPass compiled;
        const auto add_stage = [&](const Shader& shader, const gl::RasterState& state) {
            compiled.stages.push_back(compile(shader, state, defines, layout));
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
    if (skips_.has(Skip::clears)) find_last_uses();
}

// The depth counts as read in the end, like the pictures: it says which pixels a surface covers.
void CompiledPath::find_last_uses() {
    const auto uses = [](const Pass& pass, TargetId id) {
        return std::ranges::find(pass.reads, id) != pass.reads.end() ||
               std::ranges::find(pass.writes, id, &Write::target) != pass.writes.end();
    };
    for (size_t t = 0; t < path_.targets.size(); ++t) {
        const TargetId id{static_cast<int>(t)};
        if (id == path_.hdr || id == path_.display || id == path_.depth) continue;
        for (size_t i = path_.passes.size(); i-- > 0;) {
            if (!uses(path_.passes[i], id)) continue;
            compiled_[i].last_used.push_back(t);
            break;
        }
    }
}

bool CompiledPath::is_idle(const Pass& pass, const Frame& frame) const {
    if (!skips_.has(Skip::passes)) return false;
    switch (pass.idle) {
        case Idle::never:
            return false;
        case Idle::without_local_lights:
            return frame.data.light_count == frame.data.directional_count;
        case Idle::without_instances:
            return occlusion_ && occlusion_->draws(pass.instances).draws.empty();
        case Idle::without_occlusion:
            return occlusion_ && occlusion_->rests();
    }
    return false;
}

// Gives each target of the framebuffer that is bound its starting content.
void CompiledPath::load(const Pass& pass, const gl::Framebuffer& framebuffer, const Frame& frame) const {
    const auto clears = [&](const Write& w) {
        return w.load == Load::clear || (w.load == Load::discard && !skips_.has(Skip::clears));
    };
    // Clears obey the write masks.
    if (std::ranges::any_of(pass.writes, clears)) gl::apply({.depth_write = true});
    int color = 0;
    for (const auto& write : pass.writes) {
        const TargetDesc& target = path_.targets[static_cast<size_t>(write.target.index)];
        const int attachment = is_depth(target) ? -1 : color++;
        if (!clears(write)) {
            if (write.load == Load::discard) framebuffer.invalidate(attachment);
            continue;
        }
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

void CompiledPath::bind_inputs(const Pass& pass, const DrawInput& input) const {
    for (size_t r = 0; r < pass.reads.size(); ++r) {
        texture(pass.reads[r]).bind(static_cast<unsigned>(shared::kTargetUnit) + static_cast<unsigned>(r));
    }
    if (!skips_.has(Skip::code)) input.scene.bind_unneeded_textures();
    input.buffers.bind(input.scene);
    if (light_lists_) light_lists_->bind();
}

// Where shaders loop over all lights, drivers that end long loops would lose the last ones. Lists see to it themselves.
void CompiledPath::check_loops(const Frame& frame) const {
    const int64_t allowed = gl::Context::current()->limits().max_loop_rounds;
    if (light_lists_ || frame.data.light_count <= allowed) return;
    const bool loops = std::ranges::any_of(path_.passes, [](const Pass& pass) {
        return pass.shades == Shades::all_lights || pass.shades == Shades::all_lights_of_covered;
    });
    if (!loops) return;
    throw EnvironmentError(fmt::format("shaders that loop over {} lights: more than max_loop_rounds, {}",
                                       frame.data.light_count, allowed));
}

// Lists that a pass is to build are not built here.
void CompiledPath::prepare(const GpuScene& scene, const Frame& frame) {
    check_loops(frame);
    if (occlusion_) occlusion_->begin(scene, frame);
    const bool in_a_pass = std::ranges::any_of(path_.passes, [](const Pass& p) { return p.record == build_lists; });
    if (light_lists_ && !in_a_pass) light_lists_->build(frame, nullptr);
}

bool CompiledPath::grow_light_lists() { return light_lists_ && light_lists_->grow_if_cut_short(); }

// Binds all that the pass needs.
Recorder CompiledPath::begin_pass(size_t index, const DrawInput& input) {
    const Pass& pass = path_.passes[index];
    const CompiledPass& compiled = compiled_[index];
    if (!pass.writes.empty()) {
        compiled.framebuffer.bind();
        load(pass, compiled.framebuffer, input.frame);
    }
    bind_inputs(pass, input);
    Recorder recorder(input, compiled.stages, position_error_);
    recorder.set_back_face_culling(skips_.has(Skip::backface));
    if (occlusion_) {
        recorder.set_drawn_unwritten(occlusion_->draws(pass.instances),
                                     occlusion_instances_[static_cast<size_t>(pass.instances)]);
        recorder.set_occlusion(occlusion_.get(), &texture(path_.occluder_depth));
    } else {
        recorder.set_drawn(input.frame.visible, input.buffers.visible_instances());
    }
    const bool bounded = path_.light_grid && path_.light_grid->depth_bounds;
    recorder.set_light_lists(light_lists_.get(), bounded ? &texture(path_.tile_depth) : nullptr);
    if (!compiled.stages.empty()) recorder.use_stage(0);
    return recorder;
}

void CompiledPath::end_pass(size_t index) const {
    for (const size_t target : compiled_[index].last_used) textures_[target].invalidate();
}

void CompiledPath::execute(const DrawInput& input, PassTimer& timer) {
    timer.begin_frame(path_.passes.size());
    idle_passes_ = 0;
    for (size_t i = 0; i < path_.passes.size(); ++i) {
        const Pass& pass = path_.passes[i];
        gl::push_group(pass.name);
        timer.begin_pass(i);
        if (is_idle(pass, input.frame)) {
            ++idle_passes_;
        } else {
            Recorder recorder = begin_pass(i, input);
            pass.record(recorder);
        }
        end_pass(i);
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
        const uint32_t slice = shared::slice_of(grid, view_distance(data, depths[i]));
        sum += lists.cells[(slice * grid.tiles_y + y) * grid.tiles_x + x].count;
    }
    return sum;
}

uint64_t CompiledPath::count_light_evaluations(const DrawInput& input) {
    const auto& data = input.frame.data;
    uint64_t evaluations = 0;
    for (size_t i = 0; i < path_.passes.size(); ++i) {
        const Pass& pass = path_.passes[i];
        if (is_idle(pass, input.frame)) continue;
        Recorder recording = begin_pass(i, input);
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
        if (pass.idle == Idle::without_instances) continue;  // seldom draws
        for (const TargetId id : pass.reads) moved += bytes(id);
        bool writes_depth = changes_depth(pass.state);
        for (const auto& stage : pass.more_stages) writes_depth = writes_depth || changes_depth(stage.state);
        for (const Write& write : pass.writes) {
            const bool tested_only = is_depth(path_.targets[static_cast<size_t>(write.target.index)]) && !writes_depth;
            if (tested_only && std::ranges::find(pass.reads, write.target) != pass.reads.end()) continue;
            const bool cleared_first = write.load == Load::discard && !skips_.has(Skip::clears);
            const bool read_first = write.load == Load::keep && !tested_only;
            moved += bytes(write.target) * (read_first || cleared_first ? 2 : 1);
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
