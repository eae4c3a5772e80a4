#include "bench/report/assemble.h"

#include "synthetic.h"

#include "bench/report/pairs.h"
#include "renderer/base/file.h"
#include "renderer/base/resources.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::SizeIs;
namespace fs = std::filesystem;

// forward costs 1 ms and 30 us per light; deferred 2 ms and 10 us per light: they meet at 50 lights.
double crossing_at_50(const CellParams& cell) {
    return cell.path == "forward" ? 1.0e6 + 3.0e4 * *cell.lights : 2.0e6 + 1.0e4 * *cell.lights;
}

double thirty_percent(const CellParams& cell) { return cell.path == "deferred" ? 1.3e6 : 1.0e6; }

TEST(Assemble, a_planted_ratio_is_found_and_equal_arms_are_not_told_apart) {
    const auto journal = synthetic_journal({{"forward", ""}, {"forward_prepass", ""}, {"deferred", "oct16"}}, {4},
                                           thirty_percent, 200, 0.02);
    const Json report = assemble_report(journal);
    ASSERT_THAT(report.at("pairs"), SizeIs(2));
    const Json& equal = report.at("pairs")[0];
    const Json& slower = report.at("pairs")[1];
    EXPECT_EQ(slower.at("a"), journal.groups[0].cells[2].id);
    EXPECT_EQ(slower.at("b"), journal.groups[0].cells[0].id);
    EXPECT_EQ(slower.at("verdict"), "slower");
    EXPECT_EQ(slower.at("pairs"), 200);
    // The standard error of a median of 200 log-ratios with sigma 0.02 * sqrt(2) is 1.25 * 0.028 / sqrt(200) = 0.0025.
    EXPECT_NEAR(slower.at("ratio").get<double>(), 1.3, 1.3 * 4 * 0.0025);
    EXPECT_THAT(slower.at("low").get<double>(), AllOf(Ge(1.25), Le(slower.at("ratio").get<double>())));
    EXPECT_THAT(slower.at("high").get<double>(), AllOf(Le(1.35), Ge(slower.at("ratio").get<double>())));
    EXPECT_THAT(equal.at("verdict"), ::testing::AnyOf("same", "ambiguous"));
    EXPECT_NEAR(equal.at("ratio").get<double>(), 1.0, 4 * 0.0025);
}

TEST(Assemble, the_noise_floor_is_how_far_the_twins_interval_reaches) {
    const auto journal = synthetic_journal({{"forward", ""}}, {1, 4}, thirty_percent, 100, 0.02);
    const Json noise = assemble_report(journal).at("noise");
    ASSERT_THAT(noise.at("groups"), SizeIs(2));
    double expected = 0.0;
    for (const Json& group : noise.at("groups")) {
        EXPECT_NEAR(group.at("ratio").get<double>(), 1.0, 0.02);
        EXPECT_EQ(group.at("pairs"), 100);
        expected =
            std::max({expected, group.at("high").get<double>() - 1.0, 1.0 / group.at("low").get<double>() - 1.0});
    }
    EXPECT_DOUBLE_EQ(noise.at("floor").get<double>(), expected);
}

TEST(Assemble, a_difference_within_the_noise_gets_no_verdict) {
    auto journal = synthetic_journal(
        {{"forward", ""}, {"deferred", "oct16"}}, {4},
        [](const CellParams& c) { return c.path == "deferred" ? 1.03e6 : 1e6; }, 200, 0.02);
    EXPECT_EQ(assemble_report(journal).at("pairs")[0].at("verdict"), "slower");
    for (auto& ns : journal.groups[0].noise->wall_ns) ns = ns * 108 / 100;  // the twin of the same arm is 8 % off
    EXPECT_EQ(assemble_report(journal).at("pairs")[0].at("verdict"), "same");
    journal.groups[0].noise.reset();
    const Json report = assemble_report(journal);
    EXPECT_EQ(report.at("pairs")[0].at("verdict"), "ambiguous");
    EXPECT_TRUE(report.at("pairs")[0].at("floor").is_null());
    EXPECT_TRUE(report.at("noise").at("floor").is_null());
}

TEST(Assemble, arms_are_compared_with_the_first_and_with_their_forward_twin_once) {
    auto names = [](const std::vector<std::pair<std::string, std::string>>& arms) {
        const auto journal = synthetic_journal(arms, {4}, thirty_percent, 20);
        std::vector<std::string> result;
        for (const auto& pair : compare_arms(journal.groups[0], 0.01)) {
            result.push_back(pair.a->params.path + pair.a->params.layout + "/" + pair.b->params.path +
                             pair.b->params.layout);
        }
        return result;
    };
    EXPECT_THAT(names({{"forward", ""}, {"deferred", "oct16"}}), ElementsAre("deferredoct16/forward"));
    EXPECT_THAT(names({{"forward_prepass", ""}, {"forward", ""}, {"deferred", "oct16"}}),
                ElementsAre("forward/forward_prepass", "deferredoct16/forward_prepass", "deferredoct16/forward"));
    EXPECT_THAT(names({{"deferred", "oct16"}, {"forward", ""}, {"deferred", "oct32"}}),
                ElementsAre("forward/deferredoct16", "deferredoct32/deferredoct16", "deferredoct32/forward"));
    EXPECT_THAT(names({{"forward", ""}}), IsEmpty());
}

TEST(Assemble, frames_are_paired_by_round) {
    // Rounds 2 and 5 are common; there a / b is 200/100 and 400/100: the median of the log-ratios is log(2 * sqrt 2).
    const auto ratio = ratio_by_round({0, 2, 5}, {7, 200, 400}, {2, 3, 5, 6}, {100, 9, 100, 9}, 0.95);
    ASSERT_TRUE(ratio.has_value());
    EXPECT_EQ(ratio->pairs, 2U);
    EXPECT_NEAR(ratio->ratio.estimate, 2.0 * std::sqrt(2.0), 1e-12);
    EXPECT_FALSE(ratio_by_round({0, 1}, {5, 5}, {2, 3}, {5, 5}, 0.95).has_value());
}

TEST(Assemble, the_crossover_is_found_where_it_was_planted) {
    const auto journal =
        synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {256, 1, 4, 16, 64}, crossing_at_50, 100, 0.02);
    const Json crossovers = assemble_report(journal).at("crossovers");
    ASSERT_THAT(crossovers, SizeIs(1));
    const Json& crossover = crossovers[0];
    EXPECT_EQ(crossover.at("a"), (Json{{"path", "deferred"},
                                       {"layout", "oct16"},
                                       {"light_lists", nullptr},
                                       {"hdr", "rgba16f"},
                                       {"skip", "all"},
                                       {"guards", "on"},
                                       {"sums", "plain"}}));
    EXPECT_EQ(crossover.at("b"), (Json{{"path", "forward"},
                                       {"layout", nullptr},
                                       {"light_lists", nullptr},
                                       {"hdr", "rgba16f"},
                                       {"skip", "all"},
                                       {"guards", "on"},
                                       {"sums", "plain"}}));
    // Interpolating between 16 and 64 lights is not the true curve: allow what a straight line there leaves.
    EXPECT_NEAR(crossover.at("lights").get<double>(), 50.0, 5.0);
    EXPECT_LT(crossover.at("low").get<double>(), crossover.at("lights").get<double>());
    EXPECT_GT(crossover.at("high").get<double>(), crossover.at("lights").get<double>());
    EXPECT_TRUE(crossover.at("reason").is_null());
}

TEST(Assemble, without_a_crossover_there_is_a_reason) {
    const auto journal = synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {1, 4}, thirty_percent);
    const Json crossovers = assemble_report(journal).at("crossovers");
    ASSERT_THAT(crossovers, SizeIs(1));
    EXPECT_TRUE(crossovers[0].at("lights").is_null());
    EXPECT_THAT(crossovers[0].at("reason").get<std::string>(), HasSubstr("forward is faster"));
    EXPECT_THAT(assemble_report(synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {4}, thirty_percent))
                    .at("crossovers"),
                IsEmpty());
}

TEST(Assemble, says_who_is_fastest_from_which_light_count_to_which) {
    const auto journal =
        synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {1, 4, 16, 64, 256}, crossing_at_50, 60, 0.02);
    const Json report = assemble_report(journal);
    ASSERT_THAT(report.at("fastest"), SizeIs(1));
    const Json& entry = report.at("fastest")[0];
    EXPECT_EQ(entry.at("scene"), "cornell");
    EXPECT_EQ(entry.at("width_px"), 640);
    EXPECT_EQ(entry.at("layout"), "oct16");
    ASSERT_THAT(entry.at("ranges"), SizeIs(2));
    const Json& few = entry.at("ranges")[0];
    const Json& many = entry.at("ranges")[1];
    EXPECT_EQ(few.at("arm").at("path"), "forward");
    EXPECT_EQ(few.at("from_lights"), 1);
    EXPECT_EQ(few.at("to_lights"), 16);  // 1.48 ms against 2.16 ms there, 2.92 against 2.64 at 64
    EXPECT_EQ(few.at("surely"), true);
    EXPECT_EQ(many.at("arm").at("path"), "deferred");
    EXPECT_EQ(many.at("from_lights"), 64);
    EXPECT_EQ(many.at("to_lights"), 256);
    EXPECT_THAT(many.at("rivals"), IsEmpty());
    EXPECT_EQ(report.at("crossovers")[0].at("on_envelope"), true);
}

TEST(Assemble, statistics_are_those_of_the_samples) {
    auto journal = synthetic_journal({{"forward", ""}}, {1}, thirty_percent, 8);
    Samples& samples = journal.groups[0].cells[0].samples;
    samples.wall_ns = {30, 10, 20, 40, 30, 10, 20, 40};  // sorted 10 10 20 20 30 30 40 40
    const Json wall = assemble_report(journal).at("cells")[0].at("statistics").at("wall_ns");
    EXPECT_EQ(wall.at("median"), 25.0);
    EXPECT_EQ(wall.at("mean"), 25.0);
    EXPECT_EQ(wall.at("min"), 10);
    EXPECT_EQ(wall.at("max"), 40);
    EXPECT_EQ(wall.at("count"), 8);
    EXPECT_NEAR(wall.at("stddev").get<double>(), std::sqrt(1000.0 / 7.0), 1e-12);  // 4 * (15^2 + 5^2) = 1000
}

TEST(Assemble, time_against_error_says_who_is_surely_beaten_in_both) {
    // oct16 has the largest error and is the slowest; oct32 is as right as forward and faster.
    const auto journal = synthetic_journal({{"forward", ""}, {"deferred", "oct16"}, {"deferred", "oct32"}}, {4},
                                           [](const CellParams& c) {
                                               return c.layout == "oct16" ? 3e6 : c.layout == "oct32" ? 1e6 : 2e6;
                                           });
    const auto& cells = journal.groups[0].cells;
    const Json pareto = assemble_report(journal).at("pareto");
    ASSERT_THAT(pareto, SizeIs(1));
    EXPECT_EQ(pareto[0].at("metric_error"), "reference.display.flip_mean");
    EXPECT_EQ(pareto[0].at("front"), Json({cells[2].id}));
    EXPECT_EQ(pareto[0].at("perhaps"), Json::array());
    EXPECT_EQ(pareto[0].at("dominated"), Json({cells[0].id, cells[1].id}));
    EXPECT_EQ(pareto[0].at("points")[0].at("state"), "dominated");
    EXPECT_EQ(pareto[0].at("points")[2].at("state"), "front");
}

TEST(Assemble, an_arm_beaten_by_its_median_alone_is_perhaps_on_the_front) {
    const auto same_time = [](const CellParams&) { return 1e6; };
    const auto journal = synthetic_journal({{"forward", ""}, {"deferred", "oct32"}}, {4}, same_time, 13, 0.1);
    const Json pareto = assemble_report(journal).at("pareto")[0];
    const Json& points = pareto.at("points");
    const size_t slower = points[0].at("time_ns") < points[1].at("time_ns") ? 1 : 0;  // their errors are equal
    EXPECT_EQ(pareto.at("front"), Json({points[1 - slower].at("id")}));
    EXPECT_EQ(pareto.at("perhaps"), Json({points[slower].at("id")}));
    EXPECT_EQ(pareto.at("dominated"), Json::array());
    EXPECT_EQ(points[slower].at("state"), "perhaps");
}

TEST(Assemble, the_points_of_time_against_error_have_both_intervals) {
    auto journal =
        synthetic_journal({{"forward", ""}, {"deferred", "oct16"}, {"deferred", "oct32"}}, {4}, thirty_percent);
    auto& cells = journal.groups[0].cells;
    cells[0].samples.wall_ns.assign(cells[0].samples.count(), 2'000'000);
    cells[1].error->flip_mean_low.reset();
    cells[1].error->flip_mean_high.reset();
    cells[2].error->reference.reset();  // compared with the control alone: no place among the points
    const Json pareto = assemble_report(journal).at("pareto");
    ASSERT_THAT(pareto, SizeIs(1));
    const Json& points = pareto[0].at("points");
    ASSERT_THAT(points, SizeIs(2));
    EXPECT_EQ(points[0], (Json{{"id", cells[0].id},
                               {"state", "front"},
                               {"time_ns", 2e6},
                               {"time_low_ns", 2e6},
                               {"time_high_ns", 2e6},
                               {"error", 0.001},
                               {"error_low", 0.9 * 0.001},
                               {"error_high", 1.1 * 0.001}}));
    EXPECT_EQ(points[1].at("id"), cells[1].id);
    EXPECT_LT(points[1].at("time_low_ns"), points[1].at("time_ns"));
    EXPECT_GT(points[1].at("time_high_ns"), points[1].at("time_ns"));
    EXPECT_TRUE(points[1].at("error_low").is_null());
    EXPECT_TRUE(points[1].at("error_high").is_null());
    for (auto& cell : cells) cell.error.reset();
    EXPECT_THAT(assemble_report(journal).at("pareto"), IsEmpty());
}

TEST(Assemble, each_group_says_what_its_reference_was) {
    auto journal = synthetic_journal({{"forward", ""}}, {1, 4}, thirty_percent, 10);
    journal.groups[0].reference.reset();
    const Json references = assemble_report(journal).at("references");
    ASSERT_THAT(references, SizeIs(1));
    EXPECT_EQ(
        references[0],
        (Json{{"group", journal.groups[1].group},
              {"key", "00aa"},
              {"from_cache", false},
              {"seconds", 0.5},
              {"subpixel_bits", 8},
              {"control_exact", {{"median_rel", 1e-7}, {"p99_rel", 1e-6}, {"max_rel", 0.25}, {"above_1e4_px", 7}}},
              {"control_snapped", nullptr}}));
}

TEST(Assemble, answers_are_given_to_what_was_asked) {
    auto journal = synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {1, 4}, thirty_percent);
    EXPECT_THAT(assemble_report(journal).at("answers"), IsEmpty());
    journal.run.max_error = {.metric = "rmse", .limit = 0.01};
    journal.run.max_time_ns = 1e9;
    const Json answers = assemble_report(journal).at("answers");
    ASSERT_THAT(answers, SizeIs(4));
    EXPECT_EQ(answers[0].at("question"), (Json{{"metric", "rmse"}, {"limit", 0.01}}));
    EXPECT_EQ(answers[1].at("question"), (Json{{"max_time_ns", 1e9}}));
    EXPECT_EQ(answers[2].at("group"), journal.groups[1].group);
    EXPECT_EQ(answers[2].at("arm"), journal.groups[1].cells[0].id);  // the other's rmse is 0.04
}

TEST(Assemble, the_summary_counts_and_says_whether_all_is_there) {
    auto journal = synthetic_journal({{"forward", ""}, {"deferred", "oct16"}}, {1, 4}, thirty_percent, 10);
    Json report = assemble_report(journal);
    EXPECT_EQ(report.at("summary").at("complete"), true);
    EXPECT_EQ(report.at("run").at("stopped_because"), "complete");
    EXPECT_EQ(report.at("run").at("wall_s"), 4.0);
    EXPECT_EQ(report.at("run").at("frames_share"), 0.875);

    CellResult& failed = journal.groups[0].cells[1];
    failed.status = CellStatus::error;
    failed.reason = "out of memory";
    failed.samples = {};
    journal.groups.pop_back();
    report = assemble_report(journal);
    EXPECT_EQ(report.at("summary").at("counts").at("ok"), 1);
    EXPECT_EQ(report.at("summary").at("counts").at("error"), 1);
    EXPECT_EQ(report.at("summary").at("planned"), 4);
    EXPECT_EQ(report.at("summary").at("complete"), false);
    EXPECT_EQ(report.at("run").at("stopped_because"), "interrupted");
    EXPECT_TRUE(report.at("cells")[1].at("statistics").is_null());
    EXPECT_THAT(report.at("pairs"), IsEmpty());
}

class CheckedReport : public ::testing::Test {
  protected:
    void TearDown() override { fs::remove(file_); }
    // 0 when scripts/check_report.py finds no fault.
    int check(const std::string& text) {
        write_file_atomically(file_, text);
        const std::string script = resource("scripts/check_report.py").string();
        return std::system(("/usr/bin/python3 '" + script + "' '" + file_.string() + "' > /dev/null").c_str());
    }

    fs::path file_ = fs::path(::testing::TempDir()) / fmt::format("lightsweep_checked_report_{}.json", getpid());
    JournalContent journal_ = synthetic_journal({{"forward", ""}, {"deferred", "oct16"}, {"deferred_tiled", "oct32"}},
                                                {1, 4, 16}, crossing_at_50, 12);
};

TEST_F(CheckedReport, passes_the_schema_complete_failed_and_empty) {
    EXPECT_EQ(check(report_text(assemble_report(journal_))), 0);
    CellResult& failed = journal_.groups[0].cells[1];
    failed.status = CellStatus::crashed;
    failed.reason = "signal 11";
    failed.samples = {};
    failed.work.reset();
    failed.error.reset();
    failed.first_frame_ns.reset();
    failed.stop_reason.reset();
    EXPECT_EQ(check(report_text(assemble_report(journal_))), 0);
    for (auto& cell : journal_.groups[1].cells) {  // one frame: no interval, no spread
        Samples& samples = cell.samples;
        for (auto* series : {&samples.round, &samples.cpu_ns, &samples.gpu_ns, &samples.wall_ns}) series->resize(1);
        for (auto& [name, series] : samples.passes) series.resize(1);
    }
    EXPECT_EQ(check(report_text(assemble_report(journal_))), 0);
    time_out(journal_.groups[2].cells[1]);
    EXPECT_EQ(check(report_text(assemble_report(journal_))), 0);
    journal_.run.max_error = {.metric = "flip_mean", .limit = 0.01};
    journal_.run.max_time_ns = 1.0;  // nothing is as fast
    journal_.groups[2].cells[0].error = CellError{};
    journal_.groups[2].reference.reset();
    EXPECT_EQ(check(report_text(assemble_report(journal_))), 0);
    journal_.groups.clear();
    EXPECT_EQ(check(report_text(assemble_report(journal_))), 0);
}

TEST_F(CheckedReport, passes_the_schema_with_skips) {
    CellResult& all = journal_.groups[0].cells[0];
    all.work_key = "00ff";
    CellResult none = all, without = all, open = all;
    const auto become = [](CellResult& cell, const std::string& skip) {
        cell.params.skip = skip;
        cell.id = cell.params.id();
        cell.name = cell.params.name();
    };
    become(none, "none");
    none.skip_proof = SkipProof{.compared_with = all.id, .max_abs = std::nan(""), .differing_px = 1};
    become(without, "all-passes-sort");
    without.shared_with = all.id;
    without.skip_proof = SkipProof{.compared_with = all.id, .same_bits = true};
    become(open, "auto");
    open.auto_skip = SkipChoice{.skip = "all", .why = "nothing costs more", .tried_ratio = {{"sort", 0.9}}};
    open.work->skipped = {{"frustum", 4}};
    auto& cells = journal_.groups[0].cells;
    cells.insert(cells.end(), {none, without, open});
    journal_.run.planned_cells += 3;
    const Json report = assemble_report(journal_);
    ASSERT_THAT(report.at("skips"), SizeIs(2)) << "all and auto, each against none";
    EXPECT_EQ(check(report_text(report)), 0);
    const auto is_refused = [&](auto change) {
        Json changed = report;
        change(changed);
        return check(report_text(changed)) != 0;
    };
    EXPECT_TRUE(is_refused([](Json& r) { r["skips"][0]["skip"] = "cells"; })) << "it changes no frame";
    EXPECT_TRUE(is_refused([](Json& r) { r["skips"][0].erase("proof"); }));
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["params"]["skip"] = "most"; }));
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][3]["skip_proof"]["differing_px"] = -1; }));
    EXPECT_FALSE(is_refused([](Json& r) {  // a report of before
        r.erase("skips");
        for (auto& cell : r["cells"]) {
            cell["params"].erase("skip");
            for (const char* key : {"auto_skip", "work_key", "shared_with", "skip_proof"}) cell.erase(key);
        }
    }));
}

TEST_F(CheckedReport, passes_the_schema_with_guards_and_sums_which_stand_beside_the_others) {
    for (auto& group : journal_.groups) {
        SyntheticClock clock(9, 12, 0.03, 0.3);
        CellParams bare = group.cells[0].params, summed = group.cells[1].params;
        bare.guards = "off";
        summed.sums = "compensated";
        group.cells.push_back(synthetic_cell(bare, 0.9 * crossing_at_50(bare), clock));
        group.cells.push_back(synthetic_cell(summed, 1.1 * crossing_at_50(summed), clock));
    }
    journal_.run.planned_cells += static_cast<int64_t>(2 * journal_.groups.size());
    const Json report = assemble_report(journal_);
    EXPECT_EQ(check(report_text(report)), 0);
    EXPECT_THAT(report.at("pareto")[0].at("points"), SizeIs(5)) << "plain and compensated sums on one front";
    for (const Json& crossover : report.at("crossovers")) {
        for (const char* key : {"guards", "sums"}) {
            EXPECT_EQ(crossover.at("a").at(key), crossover.at("b").at(key)) << crossover;
        }
    }
    Json wrong = report;
    wrong["cells"][0]["params"]["guards"] = "some";
    EXPECT_NE(check(report_text(wrong)), 0);
    Json before = report;  // a report of before
    for (auto& cell : before["cells"]) {
        for (const char* key : {"guards", "sums"}) cell["params"].erase(key);
    }
    EXPECT_EQ(check(report_text(before)), 0);
}

TEST_F(CheckedReport, faults_are_found) {
    journal_.run.max_error = {.metric = "flip_mean", .limit = 0.01};
    const Json report = assemble_report(journal_);
    const auto is_refused = [&](auto change) {
        Json changed = report;
        change(changed);
        return check(report_text(changed)) != 0;
    };
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["samples"]["passes"]["shade"][0] = 1; })) << "sum of passes";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["samples"]["round"].erase(0); })) << "length";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][1]["id"] = r["cells"][0]["id"]; })) << "id twice";
    EXPECT_TRUE(is_refused([](Json& r) { r["summary"]["counts"]["ok"] = 1; })) << "counts";
    EXPECT_TRUE(is_refused([](Json& r) { r["summary"]["complete"] = false; })) << "complete";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["status"] = "fine"; })) << "status";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["samples"]["wall_ns"][0] = 0.5; })) << "type";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0].erase("work"); })) << "missing key";
    EXPECT_TRUE(is_refused([](Json& r) { r["references"][0]["group"] = "nowhere"; })) << "reference of no group";
    EXPECT_TRUE(is_refused([](Json& r) { r["references"].push_back(r["references"][0]); })) << "two references";
    EXPECT_TRUE(is_refused([](Json& r) { r["references"][0].erase("control_exact"); })) << "half a reference";
    EXPECT_TRUE(is_refused([](Json& r) { r["pareto"][0]["points"].erase(0); })) << "a member without a point";
    EXPECT_TRUE(is_refused([](Json& r) {
        Json& front = r["pareto"][0]["front"];
        Json& dominated = r["pareto"][0]["dominated"];
        front.push_back(dominated[0]);
        dominated.erase(0);
    })) << "a beaten cell on the front";
    EXPECT_TRUE(is_refused([](Json& r) { r["pareto"][0]["points"][0]["state"] = "perhaps"; })) << "not its list";
    EXPECT_TRUE(is_refused([](Json& r) { r["noise"]["floor"] = nullptr; })) << "surely beaten without a floor";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["error"]["lost_px"] = 640 * 360 + 1; })) << "too many lost";
    EXPECT_TRUE(is_refused([](Json& r) { r["run"]["max_error"]["metric"] = "ssim"; })) << "more is better";
    EXPECT_TRUE(is_refused([](Json& r) { r["pareto"][0]["points"][0]["error"] = 0.5; }))
        << "another error than the cell's";
    EXPECT_TRUE(is_refused([](Json& r) { r["answers"][0]["arm"] = r["cells"][8]["id"]; })) << "a winner from elsewhere";
    EXPECT_TRUE(is_refused([](Json& r) { r["answers"][0]["reason"] = "none"; })) << "a winner and no winner";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][1]["error"]["fields"]["normal"].erase("mean_deg"); })) << "field";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][2]["work"]["light_hits"] = 301; })) << "another share than said";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][2]["light_lists"]["used"] = "auto"; }))
        << "nothing is built by auto";
    EXPECT_TRUE(is_refused([](Json& r) { r["cells"][0]["too_slow_at_lights"] = 1; })) << "too slow, yet sampled";
    EXPECT_TRUE(is_refused([](Json& r) {
        r["fastest"][0]["ranges"][0]["surely"] = !r["fastest"][0]["ranges"][0]["surely"];
    })) << "surely, with rivals";
    EXPECT_TRUE(is_refused([](Json& r) { r["fastest"][0]["ranges"][0]["from_lights"] = 1000; }))
        << "a range that ends before it begins";
    EXPECT_FALSE(is_refused([](Json& r) { r["cells"][0]["colour"] = "blue"; })) << "unknown keys are allowed";
    EXPECT_NE(check("{\"schema\": NaN}"), 0);
}

}  // namespace
}  // namespace lightsweep
