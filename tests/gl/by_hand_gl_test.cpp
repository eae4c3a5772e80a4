// What skipping code must reach: a scene that lacks most features runs as fast as shaders written for it by hand. Of
// both the passes are the same, without those that find hidden instances.
#include "bench/stats/ratio.h"
#include "bench/stats/schedule.h"
#include "renderer/base/file.h"
#include "renderer/base/resources.h"
#include "renderer/gl/context.h"
#include "tests/gl/fixture.h"

#include <fmt/format.h>

#include <array>
#include <map>

namespace lightsweep {
namespace {

constexpr int kWidth = 320, kHeight = 180, kRoundsAtOnce = 40, kMostTimes = 6;
constexpr double kAllowed = 1.03;

Shader shader(const std::string& vertex, const std::string& fragment) {
    const auto file = [](const std::string& name) {
        return name == "paths/fullscreen" ? name : "../tests/gl/by_hand/" + name;
    };
    return {.vertex = file(vertex),
            .fragment = file(fragment),
            .replaced = {{"generated/matte.glsl", read_file(resource("tests/gl/by_hand/matte.glsl"))}}};
}

std::map<std::string, Shader> shaders_by_pass() {
    return {{"forward", shader("mesh", "forward")},
            {"gbuffer", shader("mesh", "gbuffer")},
            {"shade", shader("paths/fullscreen", "resolve")}};
}

class ByHand : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Paths, ByHand, testing::Values("forward", "deferred"),
                         [](const auto& c) { return std::string(c.param); });

TEST_P(ByHand, TheSkippedShadersAreAsFast) {
    const auto file = resource("tests/gl/by_hand/matte.json");
    if (!exists(file)) GTEST_SKIP() << "the shaders by hand stand in the source tree alone";
    SceneStore scenes;
    const Scene& scene = scenes.scene(file.string());
    const Subject subject{scenes.gpu_scene(file.string()),
                          make_lights(scene, scene.lights.default_count, {scene.lights.default_overlap}), kWidth,
                          kHeight};
    const SceneNeeds& needs = subject.scene.needs();
    const PathSetup setup{.needs = needs,
                          .layout = drop_unneeded(load_layout("float16"), needs),
                          .hdr = gl::Format::RGBA32F,
                          .skips = SkipSet::all().without(Skip::occlusion)};
    FrameBuffers buffers;
    const DrawShapes shapes;
    const auto arm = [&](bool by_hand) {
        Path path = find_path(GetParam()).build(setup);
        if (by_hand) {
            const auto shaders = shaders_by_pass();
            for (Pass& pass : path.passes) {
                Shader written = shaders.at(pass.name);
                written.defines = pass.shader.defines;
                pass.shader = std::move(written);
            }
        }
        post_tone_map.append(path);
        return Arm(std::move(path), setup, subject, buffers, shapes);
    };
    std::array<Arm, 2> arms{arm(false), arm(true)};
    for (Arm& each : arms) each.draw();
    expect_close(arms[1].hdr_image(), arms[0].hdr_image(), 1e-4, 1e-5, "by hand");
    std::array<std::vector<double>, 2> ns;
    std::optional<PairedRatio> ratio;
    // A noisy machine gets more rounds, until the interval says something.
    for (int time = 0; time < kMostTimes; ++time) {
        for (int round = 0; round < kRoundsAtOnce; ++round) {
            for (const size_t i : schedule(arms.size(), static_cast<size_t>(round))) {
                const int64_t start = now_ns();
                arms[i].draw();
                ns[i].push_back(static_cast<double>(now_ns() - start));
            }
        }
        ratio = ratio_of_pairs(ns[0], ns[1]);
        ASSERT_TRUE(ratio && ratio->ratio.low && ratio->ratio.high);
        if (*ratio->ratio.high <= kAllowed || *ratio->ratio.low > kAllowed) break;
    }
    RecordProperty(
        "ratio", fmt::format("{:.3f} [{:.3f}, {:.3f}]", ratio->ratio.estimate, *ratio->ratio.low, *ratio->ratio.high));
    EXPECT_LE(ratio->ratio.estimate, kAllowed) << "slower than by hand, surely so if above " << *ratio->ratio.low;
}

}  // namespace
}  // namespace lightsweep
