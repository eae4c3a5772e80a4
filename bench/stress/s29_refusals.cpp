// More than there is: targets beyond a limit and beyond the memory, framebuffers that nothing can be drawn to, buffers
// that no shader could address, a scene without anything, a million lights. Each is refused with a message or drawn
// right, and the next picture is right again.
#include "bench/stress/case.h"
#include "bench/stress/refusals.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/check.h"
#include "renderer/base/random.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texel_buffer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr int kSizePx = 2;
constexpr int kManyLights = 1 << 20;
// As S17's and S20's: the arithmetic of single precision, for a few lights.
constexpr double kRounding = 1e-4;

Scene lit_plane() {
    Scene scene =
        facing_plane({.name = "matt", .model = ShadingModel::lambert, .base_color = glm::vec3(0.8F)}, 6.0, 2.0);
    scene.lights.fixed.push_back(point_light({0.0, 0.0, 1.0}, 4.0, glm::dvec3(1.0)));
    return scene;
}

// A sum of N terms of one sign is off by at most N - 1 roundings (Higham 2002, "Accuracy and Stability of Numerical
// Algorithms", 4.2).
std::string check_picture(Drawing& drawing, const std::vector<ReferenceSurface>& surfaces) {
    const auto errors = picture_errors(drawing.reference(surfaces), drawing.draw(), 1e-3);
    const double bound = kRounding + static_cast<double>(drawing.subject().lights.size()) * 0x1p-24;
    if (errors.non_finite > 0) return fmt::format("{} values are not finite", errors.non_finite);
    if (errors.max > bound) return fmt::format("a picture is {:.3g} off", errors.max);
    return {};
}

std::string check_picture(Workbench& bench, const StressArm& arm) {
    Drawing drawing(bench, arm, lit_plane(), kSizePx, kSizePx);
    return check_picture(drawing, drawing.surfaces());
}

StressArm any_path() { return StressArm(StressArm::Choices{{std::string(kPathAxis), "deferred"}}); }

// Never drawn: a software driver takes the memory for targets when they are first written.
std::string make_targets(Workbench& bench, int width, int height) {
    const Drawing drawing(bench, any_path(), lit_plane(), width, height);
    return {};
}

// Whether the targets of a square of this size, 64 bytes a pixel and more, would take over half of the free memory: a
// path refuses that of a software driver, which would take it all.
bool are_beyond_memory(int64_t size_px) {
    const double free = static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    return 64.0 * static_cast<double>(size_px) * static_cast<double>(size_px) > 0.5 * free;
}

using Problems = std::vector<std::string>;

Problems ask_large_targets(Workbench& bench) {
    const auto limit = static_cast<int>(bench.limits.max_texture_size_px);
    Problems problems{wrong_answer(Answer::refused, [&] { return make_targets(bench, limit + 1, 1); }),
                      wrong_answer(Answer::refused, [&] { return make_targets(bench, 1, limit + 1); })};
    // A GPU says itself that it has no memory.
    if (!gl::Context::current()->info().software || are_beyond_memory(limit)) {
        problems.push_back(wrong_answer(Answer::refused_or_right, [&] { return make_targets(bench, limit, limit); }));
    }
    return problems;
}

Problems ask_framebuffers(Workbench& bench) {
    const auto frame = [](size_t colors, gl::Format format) {
        std::vector<gl::Texture> textures;
        std::vector<const gl::Texture*> targets;
        for (size_t i = 0; i < colors; ++i)
            textures.emplace_back(gl::TextureDesc{.format = format, .label = "refused"});
        for (const gl::Texture& texture : textures) targets.push_back(&texture);
        const gl::Framebuffer framebuffer(targets, nullptr, "refused");
        return std::string();
    };
    const auto too_many = static_cast<size_t>(bench.limits.max_draw_buffers) + 1;
    return {wrong_answer(Answer::refused, [&] { return frame(too_many, gl::Format::RGBA8); }),
            wrong_answer(Answer::refused, [&] { return frame(1, gl::Format::D32F); })};
}

Problems ask_large_buffers(Workbench& bench) {
    return {wrong_answer(Answer::refused, [&] {
        gl::TexelBuffer texels(gl::Buffer(size_t{0}, "refused"), gl::Format::RGBA32F);
        texels.reserve(static_cast<size_t>(bench.limits.max_texel_buffer_texels) + 1);
        return std::string();
    })};
}

Problems ask_empty_scene(Workbench& bench, const StressArm& arm) {
    return {wrong_answer(Answer::right, [&]() -> std::string {
        Scene scene;
        scene.key = "nothing";
        scene.background = {0.25, 0.5, 1.0};
        Drawing drawing(bench, arm, std::move(scene), kSizePx, kSizePx);
        const Image image = drawing.draw();
        for (size_t i = 0; i < image.rgb.size(); i += 3) {
            if (image.rgb[i] != 0.25F || image.rgb[i + 1] != 0.5F || image.rgb[i + 2] != 1.0F) {
                return "nothing is not the background";
            }
        }
        return {};
    })};
}

// From none to a million and back to one, with the same buffers.
Problems ask_many_lights(Workbench& bench, const StressArm& arm) {
    Drawing drawing(bench, arm, lit_plane(), kSizePx, kSizePx);
    const auto surfaces = drawing.surfaces();
    Random random(29);
    std::vector<Light> lights;
    for (int i = 0; i < kManyLights; ++i) {
        const glm::dvec3 place(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(0.5, 1.5));
        lights.push_back(point_light(place, 4.0, glm::dvec3(1.0 / kManyLights)));
    }
    const auto draw = [&](Answer due, const std::vector<Light>& now) {
        return wrong_answer(due, [&] {
            drawing.set_lights(now);
            return check_picture(drawing, surfaces);
        });
    };
    return {draw(Answer::right, {}), draw(Answer::refused_or_right, lights),
            draw(Answer::right, drawing.scene().lights.fixed)};
}

Problems ask(Workbench& bench, const StressArm& arm) {
    const std::string what = arm.get("what");
    if (what == "targets") return ask_large_targets(bench);
    if (what == "framebuffers") return ask_framebuffers(bench);
    if (what == "buffers") return ask_large_buffers(bench);
    if (what == "nothing") return ask_empty_scene(bench, arm);
    CHECK_THAT(what == "lights", "what = {}", what);
    return ask_many_lights(bench, arm);
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    return [&bench, arm](double) {
        Problems problems = ask(bench, arm);
        // The run goes on: with the path asked about, or any.
        const StressArm next = arm.get(kPathAxis).empty() ? any_path() : arm;
        problems.push_back(wrong_answer(Answer::right, [&] { return check_picture(bench, next); }));
        // What the device itself said of the refusals is no mistake of the next picture.
        gl::Context::current()->take_debug_errors();
        StressMeasurement found;
        for (const std::string& problem : problems) {
            if (problem.empty()) continue;
            found.error += 1.0;
            found.where = problem;
        }
        return found;
    };
}

std::vector<ArmBlock> arms() {
    ArmBlock nothing = every_path(), lights = with_list_builders(every_listing_path());
    nothing.push_back({"what", {"nothing"}});
    lights.push_back({"what", {"lights"}});
    lights.front().values.emplace_back("forward");
    return {{{"what", {"targets", "framebuffers", "buffers"}}}, nothing, lights};
}

}  // namespace

extern const StressCase stress_refusals{
    .id = "S29",
    .summary = "targets and buffers beyond limits and memory, bad framebuffers, an empty scene, a million lights",
    .measures = "things neither refused with a message nor done right, and wrong pictures after them",
    .unit = "count",
    .bound = 0.0,
    .bound_source = "a user can cure what is said, and nothing else",
    .failure = "the program ends without a word, or goes on with black pictures",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
