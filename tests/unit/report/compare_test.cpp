#include "bench/report/compare.h"

#include "input_error.h"
#include "synthetic.h"

#include "bench/report/assemble.h"
#include "bench/report/gbench_export.h"
#include "renderer/base/file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

const std::vector<std::pair<std::string, std::string>> kArms{{"forward", ""}, {"deferred", "oct16"}};

Report report_of(const JournalContent& journal) { return parse_report(assemble_report(journal), "report.json"); }

JournalContent base_journal() {
    return synthetic_journal(
        kArms, {4}, [](const CellParams&) { return 1e6; }, 300, 0.01, 0.0);
}

// deferred takes 1.2 times as long as in base_journal(); forward the same.
JournalContent slower_journal() {
    return synthetic_journal(
        kArms, {4}, [](const CellParams& c) { return c.path == "deferred" ? 1.2e6 : 1e6; }, 300, 0.01, 0.0);
}

TEST(Compare, a_report_against_itself_changed_nothing) {
    const Report report = report_of(base_journal());
    const auto comparison = compare_reports(report, report, 5.0);
    ASSERT_THAT(comparison.cells, SizeIs(2));
    for (const auto& cell : comparison.cells) {
        EXPECT_EQ(cell.ratio.estimate, 1.0);
        EXPECT_LE(*cell.ratio.low, 1.0);
        EXPECT_GE(*cell.ratio.high, 1.0);
        EXPECT_FALSE(cell.over_limit);
    }
    EXPECT_FALSE(comparison.failed);
    EXPECT_THAT(comparison.warnings, IsEmpty());
}

TEST(Compare, a_slower_cell_is_found_and_only_it_and_only_beyond_the_limit) {
    const Report base = report_of(base_journal());
    const Report next = report_of(slower_journal());
    const auto comparison = compare_reports(base, next, 5.0);
    ASSERT_THAT(comparison.cells, SizeIs(2));
    EXPECT_FALSE(comparison.cells[0].over_limit);
    EXPECT_EQ(comparison.cells[1].verdict, Verdict::slower);
    EXPECT_TRUE(comparison.cells[1].over_limit);
    EXPECT_NEAR(comparison.cells[1].ratio.estimate, 1.2, 0.01);
    EXPECT_TRUE(comparison.failed);
    EXPECT_FALSE(compare_reports(base, next, 25.0).failed);
    EXPECT_FALSE(compare_reports(base, next, std::nullopt).failed);
    EXPECT_FALSE(compare_reports(next, base, 5.0).failed) << "faster is no failure";
}

TEST(Compare, a_drift_within_the_runs_widens_the_interval) {
    const auto drifting = [](double median_ns) {
        return report_of(synthetic_journal(
            kArms, {4}, [=](const CellParams&) { return median_ns; }, 300, 0.01, 0.3));
    };
    const auto comparison = compare_reports(drifting(1e6), drifting(1.2e6), 5.0);
    EXPECT_GT(*comparison.cells[0].ratio.high - *comparison.cells[0].ratio.low, 0.3);
    EXPECT_FALSE(comparison.failed) << "a fifth is less than what these runs differ in themselves";
}

TEST(Compare, the_ratio_turns_round_with_its_reports) {
    const Report base = report_of(base_journal());
    const Report next = report_of(slower_journal());
    const auto there = compare_reports(base, next, {}).cells[1].ratio;
    const auto back = compare_reports(next, base, {}).cells[1].ratio;
    EXPECT_NEAR(there.estimate * back.estimate, 1.0, 1e-12);
    EXPECT_NEAR(*there.low * *back.high, 1.0, 1e-12);
    EXPECT_NEAR(*there.high * *back.low, 1.0, 1e-12);
}

TEST(Compare, what_cannot_be_compared_is_listed) {
    auto base_content = base_journal();
    auto new_content = base_journal();
    base_content.groups[0].cells.push_back(base_content.groups[0].cells[0]);
    base_content.groups[0].cells[2].id = "00000000000000ab";
    base_content.groups[0].cells[2].name = "old";
    new_content.groups[0].cells[0].status = CellStatus::crashed;
    new_content.groups[0].cells[0].reason = "signal 11";
    new_content.groups[0].cells.push_back(new_content.groups[0].cells[1]);
    new_content.groups[0].cells[2].id = "00000000000000cd";
    new_content.groups[0].cells[2].name = "fresh";
    new_content.environment.gl_renderer = "other";
    new_content.environment.fingerprint = environment_fingerprint(new_content.environment);
    const auto comparison = compare_reports(report_of(base_content), report_of(new_content), 5.0);
    EXPECT_THAT(comparison.cells, SizeIs(1));
    EXPECT_THAT(comparison.only_base, ElementsAre("old"));
    EXPECT_THAT(comparison.only_new, ElementsAre("fresh"));
    EXPECT_THAT(comparison.broken, ElementsAre(HasSubstr("crashed: signal 11")));
    EXPECT_THAT(comparison.warnings, ElementsAre(HasSubstr("gl_renderer"), HasSubstr("noise floor")));
    EXPECT_TRUE(comparison.failed) << "a cell that is gone must not pass for one that is fast";
    EXPECT_THAT(comparison_text(comparison),
                AllOf(HasSubstr("warning: "), HasSubstr("only in base: old"), HasSubstr("was ok, is not: ")));
    EXPECT_EQ(to_json(comparison).at("failed"), true);
}

TEST(Compare, files_that_are_no_reports_are_refused) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "lightsweep_no_report.json";
    const auto error_of = [&](const std::string& text) {
        write_file_atomically(file, text);
        return input_error([&] { read_report(file); });
    };
    EXPECT_THAT(error_of("{"), AllOf(StartsWith(file.string()), HasSubstr("not JSON")));
    EXPECT_THAT(error_of("[]"), HasSubstr("not a report"));
    EXPECT_THAT(error_of(R"({"schema": "lightsweep-report-1"})"),
                AllOf(HasSubstr("/schema: "), HasSubstr(kReportSchema), HasSubstr("not \"lightsweep-report-1\"")));
    EXPECT_THAT(error_of(fmt::format(R"({{"schema": "{}"}})", kReportSchema)), HasSubstr("'run' is missing"));
    write_file_atomically(file, report_text(assemble_report(base_journal())));
    EXPECT_EQ(read_report(file).cells.size(), 2U);
    std::filesystem::remove(file);
}

TEST(GoogleBenchmark, has_one_iteration_per_frame_and_an_error_per_failed_cell) {
    auto journal = synthetic_journal(
        kArms, {4}, [](const CellParams&) { return 1e6; }, 3);
    journal.groups[0].cells[1].status = CellStatus::timeout;
    journal.groups[0].cells[1].reason = "too slow";
    const Json exported = to_google_benchmark(report_of(journal));
    EXPECT_EQ(exported.at("context").at("num_cpus"), 2);
    const Json& benchmarks = exported.at("benchmarks");
    ASSERT_THAT(benchmarks, SizeIs(5));
    const CellResult& cell = journal.groups[0].cells[0];
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(benchmarks[i].at("name"), cell.name);
        EXPECT_EQ(benchmarks[i].at("run_type"), "iteration");
        EXPECT_EQ(benchmarks[i].at("repetitions"), 3);
        EXPECT_EQ(benchmarks[i].at("repetition_index"), i);
        EXPECT_EQ(benchmarks[i].at("iterations"), 1);
        EXPECT_EQ(benchmarks[i].at("time_unit"), "ns");
        EXPECT_EQ(benchmarks[i].at("real_time"), cell.samples.wall_ns[i]);
        EXPECT_EQ(benchmarks[i].at("cpu_time"), cell.samples.cpu_ns[i]);
    }
    auto sorted = cell.samples.wall_ns;
    std::ranges::sort(sorted);
    EXPECT_EQ(benchmarks[3].at("name"), cell.name + "_median");
    EXPECT_EQ(benchmarks[3].at("aggregate_name"), "median");
    EXPECT_EQ(benchmarks[3].at("real_time"), sorted[1]);
    EXPECT_EQ(benchmarks[4].at("error_occurred"), true);
    EXPECT_EQ(benchmarks[4].at("error_message"), "too slow");
}

}  // namespace
}  // namespace lightsweep
