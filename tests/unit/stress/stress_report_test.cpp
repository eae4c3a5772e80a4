#include "bench/stress/stress_report.h"

#include "renderer/base/file.h"
#include "renderer/base/resources.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace lightsweep {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const StressCase kFar{.id = "S16",
                      .summary = "the camera far from the origin",
                      .measures = "position",
                      .unit = "rel",
                      .bound = 1e-3,
                      .bound_source = "a formula",
                      .failure = "shimmer",
                      .parameter = StressParameter{.name = "distance", .unit = "units", .easy = 1.0, .hard = 1e4}};
const StressCase kZero{.id = "S2",
                       .summary = "roughness 0",
                       .measures = "peak",
                       .unit = "rel",
                       .bound = 1.0,
                       .bound_source = "the clamp",
                       .failure = "black pixels"};

StressArm arm(const std::string& path, const std::string& layout, const std::string& depth = "") {
    StressArm::Choices choices{{"path", path}};
    if (!layout.empty()) choices.emplace_back("layout", layout);
    if (!depth.empty()) choices.emplace_back("depth", depth);
    return StressArm(choices);
}

StressPoint point(double parameter, double error, StressVerdict verdict) {
    return {.parameter = parameter, .found = {.error = error, .law = error / 2.0}, .bound = 1e-3, .verdict = verdict};
}

StressRun made_up_run() {
    StressRun run{.arguments = {"stress"},
                  .version = "0.1.0",
                  .git_commit = {},
                  .environment = {},
                  .rounding = {},
                  .results = {},
                  .ulp = {}};
    run.environment.gl_provider = "osmesa";
    run.environment.fingerprint = environment_fingerprint(run.environment);
    run.rounding = {
        {.format = "rgba16f", .write = Rounding::truncate, .blend = Rounding::nearest, .sum_of_tenths = 399.0},
        {.format = "rgba8", .write = Rounding::nearest, .ties = Ties::to_even}};
    StressResult passed{
        .of = &kZero, .arm = arm("forward", ""), .curve = {{.parameter = 0.0, .found = {.error = 0.5}, .bound = 1.0}}};
    passed.worst = passed.curve[0];
    StressResult limited{
        .of = &kFar, .arm = arm("deferred", "float32"), .verdict = StressVerdict::limit, .breakdown = 100.0};
    limited.curve = {point(1.0, 1e-5, StressVerdict::pass), point(100.0, 2e-3, StressVerdict::limit)};
    limited.worst = limited.curve[1];
    limited.reason = "0.002 rel, bound 0.001";
    StressResult failed = limited;
    failed.arm = arm("light_prepass", "float32");
    failed.verdict = failed.curve[1].verdict = StressVerdict::fail;
    failed.curve[1].found.error = NAN;
    failed.curve[1].found.non_finite = 3;
    failed.worst = failed.curve[1];
    failed.reason = "3 values are not finite";
    StressResult refused{
        .of = &kFar, .arm = arm("forward", ""), .verdict = StressVerdict::skipped, .reason = "no such format"};
    run.results = {passed, limited, failed, refused};
    return run;
}

TEST(StressJson, tells_of_each_arm_what_was_measured_and_what_was_expected) {
    const Json json = stress_json(made_up_run());
    EXPECT_EQ(json.at("schema"), "lightsweep-stress-1");
    const Json& limited = json.at("cases")[1];
    EXPECT_EQ(limited.at("id"), "S16");
    EXPECT_EQ(limited.at("arm"), "path=deferred layout=float32");
    EXPECT_EQ(limited.at("axes"), Json({{"path", "deferred"}, {"layout", "float32"}}));
    EXPECT_EQ(limited.at("status"), "limit");
    EXPECT_EQ(limited.at("breakdown"), 100.0);
    EXPECT_EQ(limited.at("at"), 100.0);
    EXPECT_EQ(limited.at("measured"), 2e-3);
    EXPECT_EQ(limited.at("predicted"), 1e-3);
    EXPECT_EQ(limited.at("ratio"), 2.0);
    EXPECT_EQ(limited.at("parameter").at("hard"), 1e4);
    EXPECT_THAT(limited.at("curve"), SizeIs(2));
    EXPECT_EQ(limited.at("curve")[0].at("status"), "pass");
    EXPECT_EQ(json.at("summary"),
              Json({{"cases", 2}, {"arms", 4}, {"pass", 1}, {"limit", 1}, {"fail", 1}, {"skipped", 1}}));
    EXPECT_FALSE(json.contains("ulp"));
}

TEST(StressJson, what_is_not_finite_is_null_and_has_a_reason) {
    const Json failed = stress_json(made_up_run()).at("cases")[2];
    EXPECT_TRUE(failed.at("measured").is_null());
    EXPECT_EQ(failed.at("non_finite"), 3);
    EXPECT_THAT(failed.at("reason").get<std::string>(), HasSubstr("not finite"));
    EXPECT_TRUE(failed.at("curve")[1].at("measured").is_null());
}

TEST(StressJson, an_arm_that_was_not_tried_and_a_case_without_parameter_have_no_such_numbers) {
    const Json cases = stress_json(made_up_run()).at("cases");
    for (const char* key : {"measured", "predicted", "ratio", "bound", "non_finite", "at", "breakdown"}) {
        EXPECT_TRUE(cases[3].at(key).is_null()) << key;
    }
    EXPECT_TRUE(cases[0].at("parameter").is_null());
    EXPECT_TRUE(cases[0].at("at").is_null());
    EXPECT_THAT(cases[0].at("curve"), IsEmpty());
    EXPECT_EQ(cases[0].at("measured"), 0.5);
    EXPECT_TRUE(cases[0].at("reason").is_null());
}

TEST(StressJson, a_law_of_zero_has_no_ratio) {
    StressRun run = made_up_run();
    run.results[1].worst.found.law = 0.0;
    const Json limited = stress_json(run).at("cases")[1];
    EXPECT_EQ(limited.at("predicted"), 0.0);
    EXPECT_TRUE(limited.at("ratio").is_null());
}

TEST(BreakdownTables, arms_stand_where_their_case_varies_them) {
    std::vector<StressResult> results;
    for (const StressArm& each : {arm("forward", ""), arm("deferred", "float32"), arm("light_prepass", "float32"),
                                  arm("deferred", "oct16"), arm("deferred", "oct16", "D16-standard")}) {
        results.push_back({.of = &kFar, .arm = each});
    }
    EXPECT_EQ(table_of(results[0].arm, results), "paths");
    EXPECT_EQ(table_of(results[1].arm, results), "paths") << "of both, that of the paths";
    EXPECT_EQ(table_of(results[3].arm, results), "layouts");
    EXPECT_EQ(table_of(results[4].arm, results), "others") << "depth is the case's own";
    EXPECT_EQ(table_of(StressArm(), results), "others");
    EXPECT_EQ(table_of(results[1].arm, {results[1], results[3]}), "layouts") << "of a case that varies layouts alone";
    EXPECT_EQ(table_of(results[3].arm, {results[3]}), "paths");
}

class CheckedStressRun : public ::testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(file_); }
    // Whether scripts/check_report.py finds no fault.
    bool valid(const Json& json) {
        write_file_atomically(file_, report_text(json));
        const std::string script = resource("scripts/check_report.py").string();
        return std::system(("/usr/bin/python3 -B '" + script + "' '" + file_.string() + "' > /dev/null").c_str()) == 0;
    }

    std::filesystem::path file_ =
        std::filesystem::path(::testing::TempDir()) / fmt::format("lightsweep_checked_stress_{}.json", getpid());
};

TEST_F(CheckedStressRun, passes_the_schema_whole_and_empty) {
    StressRun run = made_up_run();
    EXPECT_TRUE(valid(stress_json(run)));
    UlpRow off{.function = "d_ggx", .worst_input = "a = 1", .non_finite_input = {}, .domain = "[0, 1]"}, broken = off;
    off.inputs = broken.inputs = 9;
    off.max_ulp = 2.5;
    broken.worst_input.clear();
    broken.non_finite = 9;
    broken.non_finite_input = "a = 0";
    run.ulp = {off, broken};
    EXPECT_TRUE(valid(stress_json(run)));
    run.results.clear();
    EXPECT_TRUE(valid(stress_json(run)));
}

TEST_F(CheckedStressRun, faults_are_found) {
    const Json json = stress_json(made_up_run());
    const auto is_refused = [&](auto change) {
        Json changed = json;
        change(changed);
        return !valid(changed);
    };
    EXPECT_TRUE(is_refused([](Json& r) { r["schema"] = "lightsweep-stress-2"; }));
    EXPECT_TRUE(is_refused([](Json& r) { r["environment"].erase("cores"); })) << "as the report's environment";
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][1].erase("bound_source"); }));
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][1]["status"] = "fine"; }));
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][1]["status"] = "pass"; })) << "its curve has a limit";
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][1]["reason"] = nullptr; }));
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][1]["breakdown"] = 1.0; })) << "that point passes";
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][1]["curve"][0]["parameter"] = 2e4; }));
    EXPECT_TRUE(is_refused([](Json& r) { r["cases"][2]["arm"] = r["cases"][1]["arm"]; }));
    EXPECT_TRUE(is_refused([](Json& r) { r["summary"]["limit"] = 2; }));
}

}  // namespace
}  // namespace lightsweep
