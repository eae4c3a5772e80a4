// The runner on a small group: every sample kept and adding up, failures recorded, a planted cost found.
#include "tests/gl/runner_groups.h"

#include "bench/measure/known_work.h"
#include "bench/measure/list_probe.h"
#include "bench/report/pairs.h"
#include "bench/stats/linear_fit.h"
#include "bench/stats/quantile.h"
#include "bench/stats/schedule.h"
#include "renderer/base/file.h"
#include "renderer/pass/recorder.h"
#include "renderer/post/post.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

namespace lightsweep {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;

TEST(GroupRunner, KeepsEverySampleAndTheyAddUp) {
    const auto result =
        run_group(group_of("cornell", 8, {{"forward", ""}, {"deferred", "oct32"}, {"deferred_volumes", "packed"}}), 8);
    ASSERT_EQ(result.cells.size(), 3U);
    for (const auto& cell : result.cells) {
        ASSERT_EQ(cell.status, CellStatus::ok) << cell.reason.value_or("");
        const Samples& s = cell.samples;
        ASSERT_EQ(s.count(), 8U);
        for (size_t i = 0; i < s.count(); ++i) {
            int64_t sum = 0;
            for (const auto& [name, ns] : s.passes) {
                ASSERT_EQ(ns.size(), s.count());
                sum += ns[i];
            }
            EXPECT_EQ(sum, s.gpu_ns[i]);
            EXPECT_GE(s.wall_ns[i], s.cpu_ns[i] + s.gpu_ns[i]);
        }
        EXPECT_EQ(s.passes.back().first, "unattributed");
        EXPECT_GT(*cell.first_frame_ns, 0);
        ASSERT_TRUE(cell.error && cell.error->reference && cell.error->control);
        EXPECT_EQ(cell.error->fields.empty(), cell.params.layout.empty()) << "fields of paths with a layout";
        // The interval is about the mean of equal regions, which is the map's mean but for regions a pixel larger.
        const double flip = *cell.error->reference->display.value("flip_mean");
        EXPECT_LT(*cell.error->flip_mean_low, flip * 1.05 + 1e-6);
        EXPECT_GT(*cell.error->flip_mean_high, flip * 0.95);
        EXPECT_GT(*cell.work->light_evaluations, 0);
    }
    ASSERT_TRUE(result.noise);
    EXPECT_EQ(result.noise->wall_ns.size(), 8U);
    EXPECT_EQ(result.noise->arm, result.cells.front().name);
    // Every path has the same lights to evaluate, and none can do with fewer. (A light in range may be lit from
    // behind.)
    for (const auto& cell : result.cells) {
        const CellWork& work = *cell.work;
        EXPECT_EQ(work.light_hits, result.cells.front().work->light_hits);
        EXPECT_GE(*work.light_evaluations, *work.light_hits) << cell.name;
        EXPECT_DOUBLE_EQ(*work.false_positive_rate,
                         1.0 - static_cast<double>(*work.light_hits) / static_cast<double>(*work.light_evaluations));
        EXPECT_FALSE(work.list_entries) << "no path here lists lights";
        EXPECT_FALSE(cell.light_lists);
    }
    // A volume touches a pixel only where the light reaches: never more evaluations than a full-screen pass.
    EXPECT_LE(*result.cells[2].work->light_evaluations, *result.cells[1].work->light_evaluations);
}

TEST(GroupRunner, WallIsCpuPlusGpu) {
    const auto result = run_group(group_of("cornell", 64, {{"forward", ""}, {"deferred", "float32"}}), 12);
    for (const auto& cell : result.cells) {
        std::vector<double> shares;
        for (size_t i = 0; i < cell.samples.count(); ++i) {
            shares.push_back(static_cast<double>(cell.samples.cpu_ns[i] + cell.samples.gpu_ns[i]) /
                             static_cast<double>(cell.samples.wall_ns[i]));
        }
        EXPECT_NEAR(median(shares), 1.0, 0.05) << cell.name;
    }
}

TEST(GroupRunner, ControlEqualsItself) {
    PlanGroup group = group_of("cornell", 8, {{"deferred", "float32"}});
    group.cells.front().hdr = "rgba32f";
    const auto result = run_group(group, 6);
    const auto& error = result.cells.front().error;
    ASSERT_TRUE(error && error->control && error->packing_share);
    EXPECT_TRUE(error->control->hdr.identical);
    EXPECT_TRUE(error->control->display.identical);
    EXPECT_EQ(*error->packing_share, 0.0) << "nothing is packed: all of the error is arithmetic";
    ASSERT_TRUE(result.reference && result.reference->control_exact);
    EXPECT_LT(result.reference->control_exact->median, 2e-6);
}

TEST(GroupRunner, PackingHasItsShareOfTheError) {
    PlanGroup group = group_of("cornell", 8, {{"deferred", "lecture"}, {"forward", ""}});
    for (auto& cell : group.cells) cell.hdr = "rgba32f";  // a half-float target alone costs a third of this error
    const auto result = run_group(group, 6);
    const auto& packed = result.cells[0].error;
    ASSERT_TRUE(packed && packed->packing_share);
    EXPECT_NEAR(*packed->packing_share, 1.0, 1e-2) << "8-bit normals err far more than arithmetic does";
    EXPECT_GT(*packed->reference->display.value("flip_mean"),
              10.0 * *result.cells[1].error->reference->display.value("flip_mean"));
    ASSERT_FALSE(packed->fields.empty());
    EXPECT_EQ(packed->fields.front().field, "normal");
    EXPECT_GT(packed->fields.front().mean, 0.05) << "degrees";
}

TEST(GroupRunner, LayoutsOfOneNameAreToldApart) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "two_of_a_name";
    std::vector<std::pair<std::string, std::string>> arms;
    for (const char* layout : {"oct32", "lecture"}) {
        std::filesystem::create_directories(folder / layout);
        write_file_atomically(folder / layout / "mine.json",
                              read_file(resource(fmt::format("shaders/gbuffer/layouts/{}.json", layout))));
        arms.emplace_back("deferred", (folder / layout / "mine.json").string());
    }
    const auto result = run_group(group_of("spheres", 2, arms), 2);
    const auto normal = [&](size_t i) { return result.cells[i].error->fields.front().mean; };
    EXPECT_GT(normal(1), 10.0 * normal(0)) << "8-bit normals against 16-bit ones";
    std::filesystem::remove_all(folder);
}

TEST(GroupRunner, AMapThatCannotBeWrittenCostsNothing) {
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    SamplingRules rules{.min_rounds = 2, .max_rounds = 2};
    rules.maps_folder = "/nowhere/at/all";
    const auto result = runner.run(group_of("cornell", 2, {{"forward", ""}}), rules, [](double) {});
    const CellResult& cell = result.cells.front();
    EXPECT_EQ(cell.status, CellStatus::ok);
    EXPECT_TRUE(cell.error && cell.error->reference);
    EXPECT_THAT(cell.warnings, Contains(HasSubstr("no FLIP map")));
}

TEST(GroupRunner, PixelsThatALayoutLosesAreCounted) {
    // Far depths of a wide range round to the clear value in 16 bits: those pixels become background.
    const auto file = std::filesystem::path(testing::TempDir()) / "d16.json";
    std::string text = read_file(resource("shaders/gbuffer/layouts/lecture.json"));
    text.replace(text.find("D24"), 3, "D16");
    write_file_atomically(file, text);
    const auto scene = std::filesystem::path(testing::TempDir()) / "far.json";
    write_file_atomically(scene, R"({
        "summary": "a wall in the distance",
        "materials": {"wall": {"model": "lambert"}},
        "shapes": {"wall": {"quad": {"size": [4000, 4000]}}},
        "instances": [{"shape": "wall", "material": "wall", "translate": [0, 0, -900]}],
        "camera": {"eye": [0, 0, 0], "target": [0, 0, -1], "near": 0.01, "far": 1000},
        "lights": {"default_count": 0}, "ambient": [1, 1, 1]})");
    const auto result =
        run_group(group_of(scene.string(), 0, {{"deferred", file.string()}, {"deferred", "lecture"}}), 2);
    EXPECT_EQ(result.cells[0].error->lost_px, 128 * 72);
    EXPECT_EQ(result.cells[1].error->lost_px, 0);
}

TEST(GroupRunner, ASecondRunComputesNoReference) {
    PlanGroup group = group_of("cornell", 5, {{"forward", ""}});
    group.cells.front().width = 130;  // a view of this test's own
    EXPECT_FALSE(run_group(group, 2).reference->from_cache);
    EXPECT_TRUE(run_group(group, 2).reference->from_cache);
}

TEST(GroupRunner, AFailedCellIsRecordedAndTheRestGoesOn) {
    PlanGroup group = group_of("cornell", 4, {{"deferred", "oct32"}, {"forward", ""}});
    for (auto& cell : group.cells) cell.width = cell.height = 65536;
    const auto refused = run_group(group, 6);
    for (const auto& cell : refused.cells) {
        EXPECT_EQ(cell.status, CellStatus::skipped);
        EXPECT_THAT(*cell.reason, HasSubstr("limit"));
    }
}

TEST(GroupRunner, AnArmTooSlowIsDrawnOnceAndNotWithMoreLights) {
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    SamplingRules rules{.min_rounds = 2, .max_rounds = 2};
    rules.max_frame_s = 1e-9;  // nothing is as fast
    const auto run = [&](int lights) {
        return runner.run(group_of("cornell", lights, {{"forward", ""}, {"deferred", "oct32"}}), rules, [](double) {});
    };
    const auto slow = run(4);
    for (const auto& cell : slow.cells) {
        EXPECT_EQ(cell.status, CellStatus::timeout);
        EXPECT_THAT(*cell.reason, AllOf(HasSubstr("a frame takes"), HasSubstr("1e-09 s")));
        EXPECT_EQ(cell.too_slow_at_lights, 4);
        EXPECT_GT(*cell.first_frame_ns, 0);
        EXPECT_TRUE(cell.error && cell.error->reference) << "it was drawn";
        EXPECT_TRUE(cell.work && cell.work->light_hits && !cell.work->light_evaluations);
        EXPECT_EQ(cell.samples.count(), 0U);
        EXPECT_FALSE(cell.stop_reason);
    }
    EXPECT_FALSE(slow.noise);
    const auto more = run(8);
    for (const auto& cell : more.cells) {
        EXPECT_EQ(cell.status, CellStatus::skipped);
        EXPECT_THAT(*cell.reason, AllOf(HasSubstr("with 4 lights a frame takes"), HasSubstr("not drawn")));
        EXPECT_EQ(cell.too_slow_at_lights, 4);
        EXPECT_FALSE(cell.first_frame_ns || cell.work || cell.error);
    }
    EXPECT_FALSE(more.reference) << "nothing was drawn";
    EXPECT_EQ(run(2).cells.front().status, CellStatus::timeout) << "fewer lights may be fast enough";
    rules.max_frame_s = 1e9;
    EXPECT_EQ(run(1).cells.front().status, CellStatus::ok);
}

TEST(GroupRunner, RemembersTheSlowArmsOfAJournal) {
    SceneStore scenes;
    const std::atomic<bool> never{false};
    const SamplingRules rules{.min_rounds = 2, .max_rounds = 2};
    GroupResult planted = run_group(group_of("cornell", 4, {{"forward", ""}, {"deferred", "oct32"}}), 2);
    planted.cells[0].status = CellStatus::timeout;
    planted.cells[0].reason = "a frame takes 9 s";
    planted.cells[0].too_slow_at_lights = 4;
    GroupRunner runner(scenes, "finish_clock", never);
    runner.remember(from_json<GroupResult>(Json::parse(line_text(to_json(planted))), "journal"));
    const auto result =
        runner.run(group_of("cornell", 6, {{"forward", ""}, {"deferred", "oct32"}}), rules, [](double) {});
    EXPECT_EQ(result.cells[0].status, CellStatus::skipped);
    EXPECT_THAT(*result.cells[0].reason, HasSubstr("with 4 lights a frame takes 9 s"));
    EXPECT_EQ(result.cells[1].status, CellStatus::ok);
    EXPECT_EQ(result.cells[1].samples.count(), 2U);
    EXPECT_EQ(result.noise->arm, result.cells[1].name) << "the twin is of an arm that is there";
}

TEST(GroupRunner, SaysWhoBuiltTheLightListsAndHowLongTheyAre) {
    PlanGroup group = group_of("atrium", 64, {{"deferred", "oct32"}, {"deferred_clustered", "oct32"}});
    group.cells[1].light_lists = "cpu";
    for (const char* builder : {"compute", "auto"}) {
        group.cells.push_back(group.cells[1]);
        group.cells.back().light_lists = builder;
    }
    const auto result = run_group(group, 2);
    for (size_t i = 1; i < result.cells.size(); ++i) {
        const CellResult& cell = result.cells[i];
        ASSERT_EQ(cell.status, CellStatus::ok) << cell.reason.value_or("");
        ASSERT_TRUE(cell.light_lists) << cell.name;
        EXPECT_EQ(cell.light_lists->asked, group.cells[i].light_lists);
        EXPECT_EQ(cell.params.light_lists, group.cells[i].light_lists);
        // Both builders make the same lists.
        EXPECT_EQ(cell.work->list_entries, result.cells[1].work->list_entries) << cell.name;
        EXPECT_GT(*cell.work->list_entries, 0);
        EXPECT_EQ(cell.work->light_evaluations, result.cells[1].work->light_evaluations) << cell.name;
        EXPECT_GE(*cell.work->light_evaluations, *cell.work->light_hits);
        EXPECT_LT(*cell.work->light_evaluations, *result.cells[0].work->light_evaluations) << "lists are shorter";
    }
    EXPECT_EQ(result.cells[2].light_lists->used, "compute");
    const ListChoice& automatic = *result.cells[3].light_lists;
    EXPECT_THAT(automatic.used, AnyOf("cpu", "compute"));
    EXPECT_THAT(automatic.why, AllOf(HasSubstr("cpu "), HasSubstr("compute"), HasSubstr("1,024 lights")));

    // A run that goes on takes what was chosen before, whatever a second probe would say.
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    GroupResult before = result;
    before.cells[3].light_lists = ListChoice{.asked = "auto", .used = "compute", .why = "as planted"};
    runner.remember(before);
    group.cells = {group.cells[3]};
    const auto after = runner.run(group, {.min_rounds = 2, .max_rounds = 2}, [](double) {});
    EXPECT_EQ(after.cells.front().light_lists->used, "compute");
    EXPECT_EQ(after.cells.front().light_lists->why, "as planted");
}

TEST(GroupRunner, TheControlOfManyLightsIsThatOfFew) {
    // Either side of the count from which the control takes the listed lights alone.
    PlanGroup group = group_of("atrium", 256, {{"deferred", "float32"}, {"deferred_clustered", "float32"}});
    for (auto& cell : group.cells) {
        cell.hdr = "rgba32f";
        if (!cell.light_lists.empty()) cell.light_lists = "cpu";
    }
    for (const int lights : {256, 257}) {
        for (auto& cell : group.cells) cell.lights = lights;
        group.key = group.cells.front().group();
        for (const auto& cell : run_group(group, 2).cells) {
            ASSERT_TRUE(cell.error && cell.error->control) << cell.name;
            EXPECT_LT(*cell.error->control->hdr.value("max_rel"), 1e-4) << cell.name;
        }
    }
}

TEST(ListProbe, TimesBothBuildersAndNamesTheFaster) {
    const ListProbe probe = probe_light_lists();
    EXPECT_GT(probe.cpu_ns, 0);
    ASSERT_TRUE(probe.compute_ns);
    EXPECT_GT(*probe.compute_ns, 0);
    EXPECT_EQ(probe.faster() == ListBuilder::compute, *probe.compute_ns < probe.cpu_ns);
    EXPECT_EQ(to_json(probe).at("faster"), probe.faster() == ListBuilder::cpu ? "cpu" : "compute");
}

TEST(GroupRunner, StopsWhenInterrupted) {
    SceneStore scenes;
    const std::atomic<bool> already{true};
    GroupRunner runner(scenes, "finish_clock", already);
    const auto result = runner.run(group_of("cornell", 4, {{"forward", ""}}), {}, [](double) {});
    EXPECT_EQ(result.cells.front().samples.count(), 0U);
}

// Arms of the test's own, sampled as the runner does.
std::vector<std::vector<double>> sample_arms(std::vector<Arm*> arms, size_t rounds) {
    const auto timer = make_frame_timer("finish_clock");
    for (Arm* arm : arms) arm->draw();
    std::vector<std::vector<double>> times(arms.size());
    for (size_t round = 0; round < rounds; ++round) {
        for (const size_t a : schedule(arms.size(), round)) {
            times[a].push_back(static_cast<double>(arms[a]->sample(*timer).wall_ns));
        }
    }
    return times;
}

TEST(Harness, FindsAPlantedCost) {
    // The shading pass twice: the same picture for more work. Its twin without the plant must look the same as itself.
    SceneStore scenes;
    const GpuScene& gpu_scene = scenes.gpu_scene("cornell");
    const Subject subject{gpu_scene, make_lights(scenes.scene("cornell"), 64, {}), 320, 180};
    FrameBuffers buffers;
    const DrawShapes shapes;
    const PathSetup setup{.needs = gpu_scene.needs(), .layout = drop_unneeded(load_layout("oct32"), gpu_scene.needs())};
    const auto build = [&](bool planted) {
        Path path = find_path("deferred").build(setup);
        if (planted) path.passes.push_back(path.passes.back());
        post_tone_map.append(path);
        return path;
    };
    Arm plain(build(false), setup, subject, buffers, shapes), twin(build(false), setup, subject, buffers, shapes);
    Arm planted(build(true), setup, subject, buffers, shapes);
    const auto times = sample_arms({&plain, &twin, &planted}, 24);
    const auto against_twin = ratio_of_pairs(times[1], times[0]);
    const auto against_planted = ratio_of_pairs(times[2], times[0]);
    ASSERT_TRUE(against_twin && against_planted);
    EXPECT_EQ(verdict(against_planted->ratio, 0.05), Verdict::slower);
    EXPECT_GT(against_planted->ratio.estimate, against_twin->ratio.estimate * 1.2);
    expect_close(plain.hdr_image(), planted.hdr_image(), 0.0, 0.0, "the picture");
}

TEST(Harness, ForwardIsLinearInTheLights) {
    // Fixed radius, every light reaching: nothing to cull. The fastest of several frames, against noise.
    SceneStore scenes;
    const GpuScene& gpu_scene = scenes.gpu_scene("cornell");
    FrameBuffers buffers;
    const DrawShapes shapes;
    const auto timer = make_frame_timer("finish_clock");
    CellParams cell;
    cell.path = "forward";
    std::vector<double> counts, times;
    for (const int count : {16, 32, 64, 128, 256}) {
        auto lights = make_lights(scenes.scene("cornell"), count, {});
        for (auto& light : lights) light.radius = 1e3;
        const Subject subject{gpu_scene, lights, 160, 90};
        Arm arm(cell, subject, buffers, shapes);
        int64_t fastest = INT64_MAX;
        for (int i = 0; i < 40; ++i) fastest = std::min(fastest, arm.sample(*timer).wall_ns);
        counts.push_back(count);
        times.push_back(static_cast<double>(fastest));
    }
    EXPECT_GT(linear_fit(counts, times)->r_squared, 0.99);
}

}  // namespace
}  // namespace lightsweep
