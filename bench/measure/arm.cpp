#include "bench/measure/arm.h"

#include "renderer/base/check.h"
#include "renderer/base/hash.h"
#include "renderer/gl/draw.h"
#include "renderer/paths/paths.h"
#include "renderer/post/post.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace lightsweep {
namespace {

// So many more lights out of view take 20 microseconds to leave out: no frame shows it.
constexpr uint64_t kLightsAlike = 1024;

PathSetup make_setup(const CellParams& cell, const SceneNeeds& needs) {
    const auto skips = parse_skips(cell.skip);
    CHECK_THAT(skips, "skip = {}", cell.skip);
    PathSetup setup{.needs = needs,
                    .layout = {},
                    .hdr = hdr_format(cell.hdr),
                    .skips = *skips,
                    .guards = cell.guards == kGuards.front(),
                    .compensated_sums = cell.sums == kCompensatedSums};
    if (!cell.layout.empty()) {
        const Layout whole = load_layout(cell.layout);
        const Layout needed = drop_unneeded(whole, needs);  // refuses a layout that lacks something
        setup.layout = skips->has(Skip::fields) ? needed : whole;
    }
    if (!cell.light_lists.empty()) setup.light_lists = list_builder(cell.light_lists);
    return setup;
}

Path build_path(const CellParams& cell, const PathSetup& setup) {
    Path path = find_path(cell.path).build(setup);
    post_tone_map.append(path);
    return path;
}

}  // namespace

gl::Format hdr_format(const std::string& name) {
    if (name == "rgba32f") return gl::Format::RGBA32F;
    if (name == "r11g11b10f") return gl::Format::R11G11B10F;
    CHECK_THAT(name == "rgba16f", "{}", name);
    return gl::Format::RGBA16F;
}

ListBuilder list_builder(const std::string& name) {
    const auto& names = list_builder_names();
    const auto found = std::find(names.begin(), names.end(), name);
    CHECK_THAT(found != names.end(), "{}", name);
    return static_cast<ListBuilder>(found - names.begin());
}

Arm::Arm(const CellParams& cell, const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes)
    : subject_(&subject), buffers_(&buffers), shapes_(&shapes), setup_(make_setup(cell, subject.scene.needs())) {
    path_ = std::make_unique<CompiledPath>(build_path(cell, setup_), setup_, subject.width, subject.height);
}

Arm::Arm(Path path, PathSetup setup, const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes)
    : subject_(&subject), buffers_(&buffers), shapes_(&shapes), setup_(std::move(setup)) {
    path_ = std::make_unique<CompiledPath>(std::move(path), setup_, subject.width, subject.height);
}

DrawInput Arm::build() {
    const FrameSetup frame_setup{.camera = subject_->camera.value_or(subject_->scene.scene().camera),
                                 .width = subject_->width,
                                 .height = subject_->height,
                                 .convention = setup_.layout.convention,
                                 .skips = setup_.skips};
    build_frame(subject_->scene, subject_->lights, frame_setup, frame_);
    buffers_->upload(frame_);
    path_->prepare(subject_->scene, frame_);
    return {subject_->scene, frame_, *buffers_, *shapes_};
}

FrameSample Arm::sample(FrameTimer& timer) {
    FrameSample sample;
    do {
        const int64_t start = now_ns();
        const DrawInput input = build();
        sample.cpu_ns = now_ns() - start;
        path_->execute(input, timer);
        gl::finish();
        sample.wall_ns = now_ns() - start;
        sample.gpu = timer.take();
    } while (path_->grow_light_lists());
    return sample;
}

void Arm::draw() {
    NoTimer no_timer;
    do {
        path_->execute(build(), no_timer);
        gl::finish();
    } while (path_->grow_light_lists());
}

std::string Arm::work_key() const {
    const auto bytes = [](const auto& items) {
        return std::string_view(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0]));
    };
    std::string work = path_->text();
    work += fmt::format("\nscene {} culled lights {}", subject_->scene.scene().content_hash,
                        frame_.work.lights_culled / kLightsAlike);
    // What the CPU does to build the frame.
    for (const Skip skip : {Skip::frustum, Skip::light_frustum, Skip::sort}) {
        work += setup_.skips.has(skip) ? " 1" : " 0";
    }
    work += "\n";
    work += bytes(std::span(&frame_.data, 1));
    work += bytes(frame_.visible.draws);
    work += bytes(frame_.visible.instances);
    work += bytes(frame_.lights);
    return hash_hex(work);
}

uint64_t Arm::count_light_evaluations() { return path_->count_light_evaluations(build()); }

Image Arm::hdr_image() const {
    const gl::Texture& texture = path_->hdr();
    const auto texels = texture.read_floats(3);
    Image image(texture.width(), texture.height(), ColorSpace::linear);
    const size_t row = size_t{3} * texture.width();
    for (int y = 0; y < image.height; ++y) {  // GL's first row is the bottom one
        std::copy_n(&texels[row * static_cast<size_t>(image.height - 1 - y)], row, image.pixel(0, y));
    }
    return image;
}

Image Arm::display_image() const {
    const gl::Texture& texture = path_->display();
    const auto texels = texture.read_rgba8();
    Image image(texture.width(), texture.height(), ColorSpace::display);
    for (int y = 0; y < image.height; ++y) {
        const uint8_t* source = &texels[size_t{4} * texture.width() * (image.height - 1 - y)];
        float* target = image.pixel(0, y);
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) target[3 * x + c] = static_cast<float>(source[4 * x + c]) / 255.0F;
        }
    }
    return image;
}

}  // namespace lightsweep
