#include "bench/report/skips.h"

#include "bench/report/answers.h"
#include "bench/report/assemble.h"
#include "bench/report/fastest.h"
#include "synthetic.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::SizeIs;

// With frustum a frame takes 0.8 of what it takes without; sort costs 5 %; the rest changes nothing.
double planted(const CellParams& cell) {
    const SkipSet skips = parse_skips(cell.skip).value_or(SkipSet::all());
    return 1e6 * (skips.has(Skip::frustum) ? 0.8 : 1.0) * (skips.has(Skip::sort) ? 1.05 : 1.0);
}

CellParams with_skip(CellParams cell, const std::string& skip) {
    cell.skip = skip;
    return cell;
}

// One group whose cells are the arm with each skip in turn, and a twin of the first.
GroupResult group_of(const CellParams& base, const std::vector<std::string>& skips, int rounds = 60) {
    SyntheticClock clock(5, rounds, 0.01, 0.3);
    GroupResult group;
    for (const auto& skip : skips) {
        const CellParams params = with_skip(base, skip);
        group.cells.push_back(synthetic_cell(params, planted(params), clock));
        group.cells.back().work_key = skip;
    }
    group.group = group.cells.front().group;
    group.noise =
        NoiseTwin{group.cells.front().name, clock.rounds(), clock.wall_ns(planted(group.cells.front().params))};
    return group;
}

JournalContent journal_of(GroupResult group) {
    return {synthetic_run(static_cast<int64_t>(group.cells.size())),
            synthetic_environment(),
            synthetic_timer(),
            {std::move(group)}};
}

std::vector<std::string> text(const std::vector<SkipSaving>& savings) {
    std::vector<std::string> lines;
    for (const auto& s : savings) {
        lines.push_back(s.skip + " of " + s.others + ": " + s.with->params.skip + " / " + s.without->params.skip);
    }
    return lines;
}

TEST(SkipSavings, are_of_cells_that_differ_in_one_skip_alone) {
    const CellParams forward = arm("forward", "", 4);
    EXPECT_THAT(
        text(find_skip_savings(
            group_of(forward, {"all", "none", "all-frustum", "none+sort", "all-frustum-sort", "all-cells"}), {})),
        ElementsAre("all of none: all / none", "frustum of all: all / all-frustum", "sort of none: none+sort / none",
                    "sort of all-frustum-sort: all-frustum / all-frustum-sort"))
        << "cells changes no frame";
    EXPECT_THAT(text(find_skip_savings(group_of(forward, {"none", "auto", "all-frustum-cells", "all-cells"}), {})),
                ElementsAre("auto of none: auto / none", "frustum of all: all-cells / all-frustum-cells"))
        << "in whatever order the cells stand";
    EXPECT_THAT(text(find_skip_savings(group_of(forward, {"none+cells", "none+sort+cells"}), {})),
                ElementsAre("sort of none: none+sort+cells / none+cells"));
}

TEST(SkipSavings, are_not_of_cells_that_differ_in_more) {
    GroupResult group = group_of(arm("forward", "", 4), {"all"});
    SyntheticClock clock(9, 60, 0.01, 0.3);
    for (const CellParams& other : {arm("forward_prepass", "", 4), arm("deferred", "oct16", 4)}) {
        group.cells.push_back(synthetic_cell(with_skip(other, "all-sort"), 1e6, clock));
    }
    EXPECT_THAT(find_skip_savings(group, {}), IsEmpty());

    GroupResult open = group_of(arm("auto", "oct16", 4), {"all", "none"});
    open.cells[0].auto_path = PathChoice{.path = "forward", .why = "", .expected_ns = {}, .tried_ns = {}};
    open.cells[1].auto_path = PathChoice{.path = "deferred", .why = "", .expected_ns = {}, .tried_ns = {}};
    EXPECT_THAT(find_skip_savings(open, {}), IsEmpty()) << "they came to different paths";
    open.cells[1].auto_path->path = "forward";
    EXPECT_THAT(find_skip_savings(open, {}), SizeIs(1));
}

TEST(SkipSavings, a_planted_saving_and_a_planted_cost_are_found) {
    GroupResult group = group_of(arm("forward", "", 4), {"all", "all-frustum", "all-sort", "all-passes"}, 200);
    group.cells[1].work->triangles = group.cells[0].work->triangles + 64;
    group.cells[1].work->light_evaluations = 7;
    const auto savings = find_skip_savings(group, {});
    ASSERT_THAT(text(savings), ElementsAre("frustum of all: all / all-frustum", "sort of all: all / all-sort",
                                           "passes of all: all / all-passes"));
    // Standard error of the median log ratio of 200 pairs, sigma 0.01 sqrt(2): 1.25 * 0.0141 / sqrt(200) = 0.0013.
    EXPECT_NEAR(savings[0].time->ratio.estimate, 0.8, 0.8 * 4 * 0.0013);
    EXPECT_EQ(savings[0].verdict, Verdict::faster);
    EXPECT_NEAR(*savings[0].saved_ns, 0.21e6, 0.01e6) << "1.05 ms without, 0.84 ms with, but for the drift";
    EXPECT_EQ(savings[0].work.triangles, 64);
    EXPECT_EQ(savings[0].work.draws, 0);
    EXPECT_EQ(savings[0].work.light_evaluations, std::nullopt) << "one of the two was not counted";
    EXPECT_FALSE(savings[0].same_work);
    EXPECT_NEAR(savings[1].time->ratio.estimate, 1.05, 1.05 * 4 * 0.0013);
    EXPECT_EQ(savings[1].verdict, Verdict::slower);
    EXPECT_LT(*savings[1].saved_ns, 0.0);
    EXPECT_NEAR(savings[2].time->ratio.estimate, 1.0, 4 * 0.0013);
    EXPECT_GT(*savings[2].floor, 0.0);
}

// A ratio of samples to themselves would look measured.
TEST(SkipSavings, shared_samples_have_no_ratio) {
    GroupResult group = group_of(arm("forward", "", 4), {"all", "all-passes"}, 8);
    group.cells[1].samples = group.cells[0].samples;
    group.cells[1].work_key = group.cells[0].work_key;
    group.cells[1].shared_with = group.cells[0].id;
    group.cells[1].skip_proof = SkipProof{.compared_with = group.cells[0].id, .same_bits = true};
    const auto savings = find_skip_savings(group, 0.02);
    ASSERT_THAT(savings, SizeIs(1));
    EXPECT_TRUE(savings[0].same_work);
    EXPECT_FALSE(savings[0].time);
    EXPECT_FALSE(savings[0].saved_ns);
    EXPECT_EQ(savings[0].verdict, Verdict::ambiguous);
    EXPECT_EQ(savings[0].proof->compared_with, group.cells[0].id);
    EXPECT_THAT(assemble_report(journal_of(group)).at("pairs"), IsEmpty());
}

TEST(SkipSavings, without_samples_there_is_work_but_no_time) {
    GroupResult group = group_of(arm("forward", "", 4), {"all", "all-light_lists", "none"});
    time_out(group.cells[1]);
    group.cells[2].status = CellStatus::invalid;
    group.cells[2].work.reset();
    const auto savings = find_skip_savings(group, {});
    ASSERT_THAT(text(savings), ElementsAre("light_lists of all: all / all-light_lists"));
    EXPECT_FALSE(savings[0].time || savings[0].saved_ns);
    EXPECT_EQ(savings[0].verdict, Verdict::ambiguous);
    const Json json = to_json(savings[0]);
    EXPECT_TRUE(json.at("ratio").is_null());
    EXPECT_EQ(json.at("pairs"), 0);
    EXPECT_EQ(json.at("saved_work").at("draws"), 0);
    EXPECT_EQ(json.at("path"), "forward");
    EXPECT_EQ(json.at("lights"), 4);
    EXPECT_TRUE(json.at("proof").is_null());
}

TEST(SkipSavings, a_proof_is_of_the_two_cells_and_no_others) {
    GroupResult group = group_of(arm("forward", "", 4), {"all", "none", "none+sort", "none+sort+code"});
    const auto proof = [&](size_t other, int64_t px) {
        return SkipProof{.compared_with = group.cells[other].id, .same_bits = px == 0, .differing_px = px};
    };
    group.cells[1].skip_proof = proof(0, 3);
    group.cells[2].skip_proof = proof(1, 0);
    group.cells[3].skip_proof = proof(1, 2);
    const auto savings = find_skip_savings(group, {});
    ASSERT_THAT(text(savings), ElementsAre("all of none: all / none", "sort of none: none+sort / none",
                                           "code of none+sort: none+sort+code / none+sort"));
    EXPECT_EQ(savings[0].proof->differing_px, 3);
    EXPECT_EQ(savings[1].proof->differing_px, 0) << "not what none and all differ in";
    EXPECT_FALSE(savings[2].proof) << "the two were not compared";
    group.cells[3].skip_proof = proof(1, 0);
    EXPECT_TRUE(find_skip_savings(group, {})[2].proof) << "both are the very same as a third";
}

TEST(Contest, is_among_the_cells_that_skip_everything) {
    GroupResult group = group_of(arm("forward", "", 4), {"none", "all-sort", "all", "auto"});
    EXPECT_EQ(contested_skip(group), "all");
    ASSERT_THAT(competitors(group), SizeIs(1));
    EXPECT_EQ(competitors(group)[0], &group.cells[2]);
    EXPECT_THAT(time_error_points(group, kErrorMetric), SizeIs(1));
    EXPECT_THAT(cheapest_within(group, {.metric = kErrorMetric, .limit = 1.0}, {}).statement,
                HasSubstr("no other arm is within it"));
    time_out(group.cells[2]);
    EXPECT_THAT(competitors(group), IsEmpty()) << "who contests does not hang on who was fast enough";
}

TEST(Contest, of_a_run_with_one_other_set_is_among_its_cells) {
    std::vector<GroupResult> groups;
    for (const int lights : {1, 16}) {
        GroupResult group = group_of(arm("forward", "", lights), {"none"});
        GroupResult more = group_of(arm("deferred", "oct16", lights), {"none", "none+sort"});
        std::ranges::move(more.cells, std::back_inserter(group.cells));
        groups.push_back(std::move(group));
    }
    EXPECT_EQ(contested_skip(groups[0]), "none");
    EXPECT_THAT(competitors(groups[0]), SizeIs(2));
    const auto fastest = find_fastest(groups, {});
    ASSERT_THAT(fastest, SizeIs(1));
    EXPECT_EQ(fastest[0].view.skip, "none");
    for (const auto& range : fastest[0].ranges) EXPECT_EQ(range.arm.skip, "none");
}

TEST(Contest, a_run_with_both_has_the_tables_of_one_without_the_others) {
    const auto times = [](const CellParams& c) {
        return c.path == "forward" ? 1e6 + 3e4 * *c.lights : 2e6 + 1e4 * *c.lights;
    };
    auto journal = synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {16, 64, 256}, times, 60, 0.02);
    const Json before = assemble_report(journal);
    for (auto& group : journal.groups) {
        SyntheticClock clock(3, 60, 0.02, 0.3);
        for (const size_t i : {size_t{0}, size_t{1}}) {
            const CellParams params = with_skip(group.cells[i].params, "none");
            group.cells.push_back(synthetic_cell(params, 9e6, clock));
        }
    }
    const Json after = assemble_report(journal);
    for (const char* table : {"crossovers", "fastest", "pareto"}) EXPECT_EQ(after.at(table), before.at(table)) << table;
    EXPECT_THAT(before.at("skips"), IsEmpty());
    ASSERT_THAT(after.at("skips"), SizeIs(6));
    const Json& first = after.at("skips")[0];
    EXPECT_EQ(first.at("skip"), "all");
    EXPECT_EQ(first.at("verdict"), "faster");
    EXPECT_THAT(first.at("ratio").get<double>(),
                AllOf(Ge(first.at("low").get<double>()), Le(first.at("high").get<double>())));
    EXPECT_NE(first.at("with"), first.at("without"));
}

}  // namespace
}  // namespace lightsweep
