#include "bench/report/journal.h"

#include "input_error.h"
#include "synthetic.h"

#include "bench/report/assemble.h"
#include "bench/report/merge.h"
#include "renderer/base/file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;
namespace fs = std::filesystem;

class Journal : public ::testing::Test {
  protected:
    void SetUp() override {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        file_ = fs::path(::testing::TempDir()) / (std::string("lightsweep_") + test->name() + ".jsonl");
        fs::remove(file_);
    }
    void TearDown() override { fs::remove(file_); }

    void write_groups(size_t count) {
        auto writer = JournalWriter::create(file_, content_.run, content_.environment, content_.timer);
        for (size_t i = 0; i < count; ++i) writer.append(content_.groups[i]);
    }

    fs::path file_;
    JournalContent content_ = synthetic_journal(
        {{"forward", ""}, {"deferred", "oct16"}}, {1, 4, 16}, [](const CellParams&) { return 1e6; }, 8);
};

TEST_F(Journal, what_was_appended_is_read_back) {
    write_groups(3);
    const auto back = read_journal(file_);
    EXPECT_EQ(assemble_report(back), assemble_report(content_));
}

TEST_F(Journal, every_cut_leaves_the_groups_that_were_finished) {
    write_groups(2);
    const std::string text = read_file(file_);
    const size_t first_end = text.find('\n');
    const size_t second_end = text.find('\n', first_end + 1);
    for (size_t size = 0; size <= text.size(); size += 41) {
        std::ofstream(file_, std::ios::binary | std::ios::trunc) << text.substr(0, size);
        if (size <= first_end) {
            EXPECT_THAT(input_error([&] { read_journal(file_); }), HasSubstr("start a new run"));
        } else {
            EXPECT_THAT(read_journal(file_).groups, SizeIs(size <= second_end   ? 0
                                                           : size < text.size() ? 1
                                                                                : 2))
                << size;
        }
    }
}

TEST_F(Journal, resume_cuts_the_torn_end_and_goes_on) {
    write_groups(2);
    std::ofstream(file_, std::ios::app) << R"({"kind":"group","group":"scene=cor)";
    JournalWriter::resume(file_).append(content_.groups[2]);
    EXPECT_EQ(assemble_report(read_journal(file_)), assemble_report(content_));
}

TEST_F(Journal, a_question_about_an_unknown_metric_is_refused_with_its_place) {
    content_.run.max_error = {.metric = "beauty", .limit = 0.5};
    write_groups(1);
    EXPECT_THAT(input_error([&] { read_journal(file_); }),
                AllOf(StartsWith(file_.string() + ":1:/run/max_error/metric: "), HasSubstr("known: flip_mean")));
}

TEST_F(Journal, a_broken_line_is_refused_with_its_number) {
    write_groups(2);
    std::ofstream(file_, std::ios::app) << "{\"kind\":\n";
    EXPECT_THAT(input_error([&] { read_journal(file_); }), StartsWith(file_.string() + ":4: not a journal's line"));
}

// Statistics pair what was taken in one frame.
TEST_F(Journal, lists_of_different_length_are_refused_with_their_place) {
    content_.groups[0].cells[0].samples.gpu_ns.pop_back();
    write_groups(1);
    EXPECT_THAT(input_error([&] { read_journal(file_); }), HasSubstr(".jsonl:2:/cells/0/samples/gpu_ns: "));
}

TEST_F(Journal, deep_nesting_is_refused) {
    std::ofstream(file_) << std::string(100'000, '[') << '\n';
    EXPECT_THAT(input_error([&] { read_journal(file_); }), HasSubstr("nests deeper than 100"));
}

TEST_F(Journal, lines_of_another_kind_or_twice_are_refused) {
    write_groups(1);
    const std::string text = read_file(file_);
    const std::string run_line = text.substr(0, text.find('\n') + 1);
    const std::string group_line = text.substr(run_line.size());
    const auto error_of = [&](const std::string& content) {
        std::ofstream(file_, std::ios::binary | std::ios::trunc) << content;
        return input_error([&] { read_journal(file_); });
    };
    EXPECT_THAT(error_of(run_line + group_line + group_line), AllOf(HasSubstr(":3: "), HasSubstr("twice")));
    EXPECT_THAT(error_of(group_line), AllOf(HasSubstr(":1: "), HasSubstr("kind \"run\"")));
    EXPECT_THAT(error_of(run_line + run_line), AllOf(HasSubstr(":2: "), HasSubstr("kind \"group\"")));
    EXPECT_THAT(error_of("[1]\n"), AllOf(HasSubstr(":1: "), HasSubstr("'kind' is missing")));
    EXPECT_THAT(error_of(fmt::format("{{\"kind\":\"run\",\"schema\":\"{}\"}}\n", kReportSchema)),
                HasSubstr("'run' is missing"));
    for (const char* old : {"{\"kind\":\"run\"}\n", "{\"kind\":\"run\",\"schema\":\"lightsweep-report-1\"}\n"}) {
        EXPECT_THAT(error_of(old), AllOf(HasSubstr(":1:/schema: "), HasSubstr(kReportSchema)));
    }
}

TEST_F(Journal, an_existing_file_is_not_overwritten) {
    write_groups(1);
    const std::string before = read_file(file_);
    EXPECT_THAT(input_error([&] { write_groups(1); }), AllOf(StartsWith(file_.string()), HasSubstr("exists already")));
    EXPECT_EQ(read_file(file_), before);
}

TEST_F(Journal, resuming_needs_the_same_plan_program_and_environment) {
    EXPECT_EQ(finished_groups(content_, "j", content_.run, content_.environment).size(), 3U);
    EXPECT_TRUE(finished_groups(content_, "j", content_.run, content_.environment).contains(content_.groups[1].group));
    const auto error_of = [&](auto change) {
        RunInfo run = content_.run;
        Environment environment = content_.environment;
        change(run, environment);
        environment.fingerprint = environment_fingerprint(environment);
        return input_error([&] { finished_groups(content_, "j", run, environment); });
    };
    EXPECT_THAT(error_of([](RunInfo& run, Environment&) { run.plan_hash = "ff"; }), HasSubstr("its plan is 0011"));
    EXPECT_THAT(error_of([](RunInfo& run, Environment&) { run.shard = {1, 2}; }), HasSubstr("its shard is 1/1"));
    EXPECT_THAT(error_of([](RunInfo& run, Environment&) { run.seed = 8; }), HasSubstr("its seed is 7"));
    EXPECT_THAT(error_of([](RunInfo& run, Environment&) { run.version = "9"; }), HasSubstr("program version"));
    EXPECT_THAT(error_of([](RunInfo&, Environment& e) { e.gl_renderer = "softpipe"; }),
                HasSubstr(R"(gl_renderer: "llvmpipe" / "softpipe")"));
}

TEST_F(Journal, shards_merge_to_what_one_run_would_have_written) {
    std::vector<NamedJournal> shards(3, {"", content_});
    for (int i = 0; i < 3; ++i) {
        shards[i].file = "shard" + std::to_string(i + 1);
        shards[i].content.run.shard = {i + 1, 3};
        shards[i].content.run.planned_cells = 2;
        shards[i].content.groups = {content_.groups[i]};
    }
    EXPECT_EQ(assemble_report(merge_journals(shards)), assemble_report(content_));

    const auto incomplete = assemble_report(merge_journals(std::span(shards).first(2)));
    EXPECT_EQ(incomplete.at("summary").at("complete"), false);
    EXPECT_EQ(incomplete.at("summary").at("planned"), 6);

    auto same = shards;
    same[2] = same[0];
    EXPECT_THAT(input_error([&] { merge_journals(same); }), HasSubstr("the shard 1 is in shard1 already"));
    auto twice = shards;
    twice[2].content.groups = shards[0].content.groups;
    EXPECT_THAT(input_error([&] { merge_journals(twice); }), AllOf(HasSubstr("the group"), HasSubstr("shard1")));
    auto other_plan = shards;
    other_plan[1].content.run.plan_hash = "ff";
    EXPECT_THAT(input_error([&] { merge_journals(other_plan); }), AllOf(StartsWith("shard2: "), HasSubstr("plan")));
    auto other_machine = shards;
    other_machine[1].content.environment.cpu = "faster";
    other_machine[1].content.environment.fingerprint = environment_fingerprint(other_machine[1].content.environment);
    EXPECT_THAT(input_error([&] { merge_journals(other_machine); }),
                AllOf(StartsWith("shard2: "), HasSubstr("environments differ"), HasSubstr("faster")));
}

TEST_F(Journal, merging_one_journal_is_that_journal) {
    const std::vector<NamedJournal> one{{"j", content_}};
    EXPECT_EQ(assemble_report(merge_journals(one)), assemble_report(content_));
}

}  // namespace
}  // namespace lightsweep
