// The runner and skips: what is the same work is measured once, what was skipped is counted and proved, auto is chosen.
#include "tests/gl/runner_groups.h"

#include "bench/measure/cost_model.h"
#include "bench/measure/skip_choice.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

PlanGroup skipping(const std::string& scene, int lights, const std::string& path, const std::string& layout,
                   const std::vector<std::string>& skips) {
    PlanGroup group = group_of(scene, lights, {{path, layout}});
    group.cells.resize(skips.size(), group.cells.front());
    for (size_t i = 0; i < skips.size(); ++i) group.cells[i].skip = skips[i];
    return group;
}

TEST(RunnerSkips, CellsOfTheSameWorkShareSamples) {
    // A path that lists no lights has no use for the lists.
    const auto group = skipping("cornell", 8, "deferred", "oct32",
                                {"all", "all-light_lists", "all-light_lists-cells", "none", "none+light_lists"});
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    const SamplingRules rules{.min_rounds = 3, .max_rounds = 3};
    const auto result = runner.run(group, rules, [](double) {});
    for (const auto& cell : result.cells) {
        ASSERT_EQ(cell.status, CellStatus::ok) << cell.reason.value_or("");
        ASSERT_EQ(cell.samples.count(), 3U) << cell.name;
        EXPECT_EQ(cell.stop_reason, "max_rounds");
    }
    const CellResult &all = result.cells[0], &shared = result.cells[1], &own = result.cells[2], &none = result.cells[3];
    EXPECT_EQ(shared.shared_with, all.id);
    EXPECT_EQ(shared.samples.wall_ns, all.samples.wall_ns);
    EXPECT_EQ(shared.work->light_evaluations, all.work->light_evaluations);
    EXPECT_EQ(shared.error->reference->display.values, all.error->reference->display.values);
    EXPECT_EQ(own.work_key, all.work_key);
    EXPECT_FALSE(own.shared_with) << "it has its own samples of the same work";
    EXPECT_NE(none.work_key, all.work_key);
    EXPECT_EQ(result.cells[4].work_key, none.work_key);
    EXPECT_FALSE(result.cells[4].shared_with);
    EXPECT_FALSE(all.skip_proof);
    for (size_t i = 1; i < result.cells.size(); ++i) {
        ASSERT_TRUE(result.cells[i].skip_proof) << result.cells[i].name;
        EXPECT_EQ(result.cells[i].skip_proof->compared_with, i <= 3 ? all.id : none.id);
        EXPECT_LT(result.cells[i].skip_proof->max_rel, 1e-2) << result.cells[i].name;
    }
    EXPECT_TRUE(shared.skip_proof->same_bits);

    // The same cells again, in this run and in one that goes on with its journal.
    PlanGroup sharing = group;
    sharing.cells.resize(2);
    GroupRunner next(scenes, "finish_clock", never);
    next.remember(from_json<GroupResult>(Json::parse(line_text(to_json(result))), "journal"));
    for (GroupRunner* again : {&runner, &next}) {
        const auto known = again->run(sharing, rules, [](double) {});
        for (const auto& cell : known.cells) {
            EXPECT_EQ(cell.shared_with, all.id);
            EXPECT_EQ(cell.samples.wall_ns, all.samples.wall_ns);
            EXPECT_TRUE(cell.error && cell.error->reference);
        }
        ASSERT_TRUE(known.noise);
        EXPECT_EQ(known.noise->wall_ns, result.noise->wall_ns);
    }
    EXPECT_FALSE(runner.run(group, rules, [](double) {}).cells[0].shared_with) << "some of them are not for sharing";
}

TEST(RunnerSkips, SaysWhatWasSkipped) {
    const auto result = run_group(skipping("atrium", 64, "deferred_clustered", "oct32", {"all", "none"}), 2);
    const CellResult &all = result.cells[0], &none = result.cells[1];
    ASSERT_TRUE(all.measured() && none.measured());
    const auto skipped = [](const CellResult& cell, const std::string& key) {
        const auto found = cell.work->skipped.find(key);
        return found == cell.work->skipped.end() ? 0 : found->second;
    };
    EXPECT_GT(skipped(all, "frustum"), 0) << "the hall goes on behind the camera";
    EXPECT_EQ(skipped(all, "frustum"), all.work->instances_culled);
    EXPECT_EQ(none.work->instances_drawn,
              all.work->instances_drawn + skipped(all, "frustum") + skipped(all, "occlusion"));
    EXPECT_LT(all.work->triangles, none.work->triangles);
    EXPECT_EQ(none.work->lights_drawn, all.work->lights_drawn + skipped(all, "light_frustum"));
    EXPECT_GT(skipped(all, "fields"), 0) << "the hall has no emission";
    EXPECT_EQ(none.work->gbuffer_bytes_per_px, all.work->gbuffer_bytes_per_px + skipped(all, "fields"));
    EXPECT_TRUE(none.work->skipped.empty());
    EXPECT_LT(*all.work->light_evaluations, *none.work->light_evaluations);
}

TEST(RunnerSkips, AutoComesToSkipsThatAreDrawnAsIfNamed) {
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    const SamplingRules rules{.min_rounds = 2, .max_rounds = 2};
    const auto result =
        runner.run(skipping("cornell", 8, "forward_clustered", "", {"all", "auto"}), rules, [](double) {});
    const CellResult& open = result.cells[1];
    ASSERT_EQ(open.status, CellStatus::ok) << open.reason.value_or("");
    ASSERT_TRUE(open.auto_skip);
    EXPECT_TRUE(open.skips() && open.skips()->has(Skip::cells));
    EXPECT_FALSE(open.auto_skip->why.empty());
    EXPECT_EQ(open.params.skip, "auto");
    for (const auto& info : skip_infos()) {
        const auto tried = open.auto_skip->tried_ratio.find(std::string(info.key));
        const bool pays = tried != open.auto_skip->tried_ratio.end() && tried->second <= 1.0 + kSkipMustSave;
        EXPECT_TRUE(!pays || open.skips()->has(info.skip)) << info.key;
    }
    const auto named = run_group(skipping("cornell", 8, "forward_clustered", "", {"all", open.auto_skip->skip}), 2);
    EXPECT_EQ(named.cells[1].work_key, open.work_key);

    // What was chosen holds for the rest of the run, whatever a second trial would say.
    GroupRunner next(scenes, "finish_clock", never);
    GroupResult planted = result;
    planted.cells[1].auto_skip = SkipChoice{.skip = "all-backface", .why = "as planted", .tried_ratio = {}};
    next.remember(planted);
    PlanGroup group = skipping("cornell", 8, "forward_clustered", "", {"auto"});
    group.cells.front().hdr = "rgba32f";
    const auto after = next.run(group, rules, [](double) {});
    EXPECT_EQ(after.cells.front().auto_skip->why, "as planted");
}

TEST(RunnerSkips, OpenPathsAndSkipsShareTheSamplesOfTheArmTheyComeTo) {
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    CostModel costs;
    CostSample sample{.frame = {.draws = 1.0, .pixels = 1e4}, .ns = 1e6};
    costs.paths["forward"] = fit_path_cost(LightSearch::all, {sample});
    runner.know_costs(costs);
    PlanGroup group = skipping("cornell", 8, "forward", "", {"all", "auto", "all", "auto", "none"});
    for (size_t i = 2; i < group.cells.size(); ++i) {
        group.cells[i].path = "auto";
        group.cells[i].layout = "oct32";
        group.cells[i].light_lists = "auto";
    }
    const auto cells = runner.run(group, {.min_rounds = 2, .max_rounds = 2}, [](double) {}).cells;
    for (size_t i = 0; i < cells.size(); ++i) {
        ASSERT_EQ(cells[i].status, CellStatus::ok) << cells[i].reason.value_or("");
        EXPECT_EQ(cells[i].auto_path.has_value(), i >= 2);
        EXPECT_EQ(cells[i].auto_skip.has_value(), i % 2 == 1);
        EXPECT_EQ(cells[i].skip_proof.has_value(), i != 0 && i != 2) << "each compared with the first of its path";
    }
    EXPECT_EQ(cells[2].shared_with, cells[0].id);
    EXPECT_EQ(cells[3].auto_skip->skip, cells[1].auto_skip->skip) << "chosen once";
    EXPECT_EQ(cells[3].work_key, cells[1].work_key);
    EXPECT_TRUE(cells[3].shared_with);
    EXPECT_FALSE(cells[4].shared_with);
    EXPECT_EQ(cells[4].skip_proof->compared_with, cells[2].id);
}

}  // namespace
}  // namespace lightsweep
