#include "bench/report/record.h"

#include "input_error.h"
#include "synthetic.h"

#include <gmock/gmock.h>

#include <limits>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

GroupResult one_group() {
    auto journal = synthetic_journal(
        {{"forward", ""}, {"deferred", "oct16"}}, {4}, [](const CellParams&) { return 1e6; }, 5);
    return journal.groups.front();
}

TEST(Record, json_read_back_gives_the_same_json) {
    GroupResult group = one_group();
    group.cells[1].status = CellStatus::timeout;
    group.cells[1].reason = "slow \"line\"\n";
    group.cells[1].work.reset();
    group.cells[1].error.reset();
    const Json json = to_json(group);
    EXPECT_EQ(to_json(from_json<GroupResult>(Json::parse(line_text(json)), "x")), json);
    for (const Json& other :
         {to_json(synthetic_run(3)), to_json(synthetic_environment()), to_json(synthetic_timer())}) {
        EXPECT_FALSE(other.empty());
    }
    EXPECT_EQ(to_json(from_json<RunInfo>(to_json(synthetic_run(3)), "x")), to_json(synthetic_run(3)));
    EXPECT_EQ(to_json(from_json<Environment>(to_json(synthetic_environment()), "x")), to_json(synthetic_environment()));
    EXPECT_EQ(to_json(from_json<TimerReport>(to_json(synthetic_timer()), "x")), to_json(synthetic_timer()));
}

TEST(Record, values_survive_the_round_trip) {
    const GroupResult group = one_group();
    const auto back = from_json<GroupResult>(Json::parse(line_text(to_json(group))), "x");
    EXPECT_EQ(back.cells[1].params, group.cells[1].params);
    EXPECT_EQ(back.cells[1].samples.wall_ns, group.cells[1].samples.wall_ns);
    EXPECT_EQ(back.cells[1].samples.passes, group.cells[1].samples.passes);  // names, values and their order
    EXPECT_EQ(back.cells[0].work->skipped, group.cells[0].work->skipped);
    EXPECT_EQ(back.noise->wall_ns, group.noise->wall_ns);
    EXPECT_EQ(back.wall_s, 2.0);
}

TEST(Record, light_lists_and_slow_arms_survive_the_round_trip) {
    auto journal = synthetic_journal(
        {{"forward", ""}, {"deferred_tiled", "oct16"}}, {4}, [](const CellParams&) { return 1e6; }, 5);
    time_out(journal.groups[0].cells[0]);
    const Json json = to_json(journal.groups[0]);
    EXPECT_EQ(json.at("cells")[1].at("light_lists"),
              (Json{{"asked", "auto"}, {"used", "cpu"}, {"why", "cpu 1 ms, compute 2 ms"}}));
    EXPECT_TRUE(json.at("cells")[0].at("light_lists").is_null());
    EXPECT_TRUE(json.at("cells")[0].at("params").at("light_lists").is_null());
    const auto back = from_json<GroupResult>(Json::parse(line_text(json)), "x");
    EXPECT_EQ(back.cells[0].status, CellStatus::timeout);
    EXPECT_EQ(back.cells[0].too_slow_at_lights, 4);
    EXPECT_EQ(back.cells[1].too_slow_at_lights, std::nullopt);
    EXPECT_EQ(back.cells[1].params.light_lists, "auto");
    EXPECT_EQ(back.cells[1].light_lists->used, "cpu");
    EXPECT_EQ(back.cells[1].work->light_hits, 300);
    EXPECT_EQ(back.cells[1].work->false_positive_rate, 0.25);
    EXPECT_EQ(back.cells[1].work->list_entries, 77);
    EXPECT_EQ(back.cells[0].work->light_hits, std::nullopt);
    EXPECT_EQ(from_json<RunInfo>(to_json(synthetic_run(3)), "x").max_frame_s, 1.5);
}

TEST(Record, skips_survive_the_round_trip) {
    GroupResult group = one_group();
    CellResult& cell = group.cells[1];
    cell.params.skip = "auto";
    cell.auto_skip = SkipChoice{.skip = "all-sort", .why = "one instance", .tried_ratio = {{"occlusion", 0.75}}};
    cell.work_key = "00ff";
    cell.shared_with = "0123456789abcdef";
    cell.skip_proof = SkipProof{.compared_with = "fedcba9876543210",
                                .same_bits = false,
                                .max_abs = std::numeric_limits<double>::infinity(),
                                .max_rel = 0.5,
                                .differing_px = 3};
    const Json json = to_json(group);
    EXPECT_EQ(json.at("cells")[0].at("params").at("skip"), "all");
    EXPECT_TRUE(json.at("cells")[0].at("skip_proof").is_null());
    EXPECT_TRUE(json.at("cells")[1].at("skip_proof").at("max_abs").is_null()) << "not finite";
    const auto back = from_json<GroupResult>(Json::parse(line_text(json)), "x").cells[1];
    EXPECT_EQ(back.params.skip, "auto");
    EXPECT_EQ(back.auto_skip->skip, "all-sort");
    EXPECT_EQ(back.auto_skip->tried_ratio.at("occlusion"), 0.75);
    EXPECT_EQ(back.work_key, "00ff");
    EXPECT_EQ(back.shared_with, cell.shared_with);
    EXPECT_EQ(back.skip_proof->compared_with, "fedcba9876543210");
    EXPECT_EQ(back.skip_proof->max_rel, 0.5);
    EXPECT_EQ(back.skip_proof->differing_px, 3);
    EXPECT_FALSE(back.skip_proof->same_bits);
    EXPECT_EQ(back.skips(), SkipSet::all().without(Skip::sort)) << "as it was drawn";
    EXPECT_EQ(group.cells[0].skips(), SkipSet::all());
}

TEST(Record, what_may_be_null_may_be_missing_in_files_of_before) {
    Json json = to_json(one_group());
    for (auto& cell : json["cells"]) {
        for (const char* key :
             {"light_lists", "too_slow_at_lights", "auto_skip", "work_key", "shared_with", "skip_proof"}) {
            cell.erase(key);
        }
        cell["params"].erase("light_lists");
        cell["params"].erase("skip");
        for (const char* key : {"light_hits", "false_positive_rate", "list_entries"}) cell["work"].erase(key);
    }
    EXPECT_EQ(to_json(from_json<GroupResult>(json, "x")), to_json(one_group()));
}

TEST(Record, errors_survive_the_round_trip) {
    GroupResult group = one_group();
    group.cells[1].error->control->display.identical = true;
    const auto back = from_json<GroupResult>(Json::parse(line_text(to_json(group))), "x");
    const CellError& error = *back.cells[1].error;
    EXPECT_EQ(error.reference->display.value("flip_mean"), 0.02);
    EXPECT_EQ(error.reference->hdr.value("rmse"), 0.1);
    EXPECT_EQ(error.reference->hdr.value("flip_mean"), std::nullopt);
    EXPECT_FALSE(error.reference->display.identical);
    EXPECT_EQ(error.control->display.value("flip_mean"), 0.019);
    EXPECT_TRUE(error.control->display.identical);
    EXPECT_DOUBLE_EQ(*error.packing_share, 0.95);
    EXPECT_DOUBLE_EQ(*error.flip_mean_low, 0.018);
    EXPECT_DOUBLE_EQ(*error.flip_mean_high, 0.022);
    ASSERT_EQ(error.fields.size(), 2U);
    EXPECT_EQ(error.fields[0].field, "normal");  // their order too
    EXPECT_EQ(error.fields[0].unit, "deg");
    EXPECT_EQ(error.fields[0].mean, 0.02);
    EXPECT_EQ(error.fields[0].p99, 0.05);
    EXPECT_EQ(error.fields[0].max, 0.1);
    EXPECT_EQ(back.reference->key, "00aa");
    EXPECT_EQ(back.reference->seconds, 0.5);
    EXPECT_EQ(back.reference->subpixel_bits, 8);
    EXPECT_EQ(back.reference->control_exact->median, 1e-7);
    EXPECT_EQ(back.reference->control_exact->above_1e4_px, 7);
    EXPECT_FALSE(back.reference->control_snapped.has_value());
}

TEST(Record, what_an_error_lacks_is_null_and_stays_absent) {
    GroupResult group = one_group();
    group.reference.reset();
    group.cells[0].error = CellError{};
    const Json json = to_json(group);
    EXPECT_TRUE(json.at("reference").is_null());
    const Json& error = json.at("cells")[0].at("error");
    for (const char* key : {"reference", "control", "packing_share", "flip_mean_low", "flip_mean_high"}) {
        EXPECT_TRUE(error.at(key).is_null()) << key;
    }
    EXPECT_EQ(error.at("fields"), Json::object());
    const auto back = from_json<GroupResult>(json, "x");
    EXPECT_FALSE(back.reference.has_value());
    EXPECT_FALSE(back.cells[0].error->reference.has_value());
    EXPECT_FALSE(back.cells[0].error->packing_share.has_value());
    EXPECT_TRUE(back.cells[0].error->fields.empty());
}

TEST(Record, the_units_of_field_errors_stand_in_their_keys) {
    Json json = to_json(one_group());
    Json& fields = json["cells"][1]["error"]["fields"];
    EXPECT_EQ(fields, (Json{{"normal", {{"mean_deg", 0.02}, {"p99_deg", 0.05}, {"max_deg", 0.1}}},
                            {"roughness", {{"mean_abs", 0.0}, {"p99_abs", 0.0}, {"max_abs", 0.0}}}}));
    fields["normal"].erase("p99_deg");
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(json, "f:"); }),
                AllOf(StartsWith("f:/cells/1/error/fields/normal: "), HasSubstr("'p99_deg' is missing")));
    fields["normal"] = Json::object();
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(json, "f:"); }), HasSubstr("'mean_<unit>' is missing"));
    fields["normal"] = 3;
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(json, "f:"); }), HasSubstr("an object was expected"));
}

TEST(Record, what_was_asked_survives_the_round_trip) {
    RunInfo run = synthetic_run(3);
    EXPECT_TRUE(to_json(run).at("max_error").is_null());
    EXPECT_TRUE(to_json(run).at("max_time_ns").is_null());
    run.max_error = {.metric = "rmse", .limit = 0.25};
    run.max_time_ns = 8e6;
    EXPECT_EQ(to_json(run).at("max_error"), (Json{{"metric", "rmse"}, {"limit", 0.25}}));
    const auto back = from_json<RunInfo>(to_json(run), "x");
    EXPECT_EQ(back.max_error->metric, "rmse");
    EXPECT_EQ(back.max_error->limit, 0.25);
    EXPECT_EQ(back.max_time_ns, 8e6);
}

TEST(Record, a_limit_is_refused_with_its_place_unless_it_bounds_a_metric) {
    RunInfo run = synthetic_run(3);
    for (const std::string& metric : kBoundableMetrics) {
        run.max_error = {.metric = metric, .limit = 0.25};
        EXPECT_EQ(from_json<RunInfo>(to_json(run), "x").max_error->metric, metric);
        EXPECT_TRUE(synthetic_image_error({}).value(metric) == std::nullopt) << "a metric of pictures";
    }
    Json json = to_json(run);
    json["max_error"]["metric"] = "flip_men";
    EXPECT_THAT(input_error([&] { from_json<RunInfo>(json, "f:"); }),
                AllOf(StartsWith("f:/max_error/metric: "), HasSubstr("did you mean 'flip_mean'"), HasSubstr("rmse")));
    json["max_error"]["metric"] = "ssim";  // more is better
    EXPECT_THAT(input_error([&] { from_json<RunInfo>(json, "f:"); }), HasSubstr("unknown metric 'ssim'"));
    json = to_json(run);
    for (const Json& limit : {Json(-0.5), Json(nullptr)}) {
        json["max_error"]["limit"] = limit;
        EXPECT_THAT(input_error([&] { from_json<RunInfo>(json, "f:"); }), StartsWith("f:/max_error/limit: "));
    }
}

TEST(Record, what_is_not_finite_becomes_null) {
    RunInfo run = synthetic_run(1);
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        run.target_ci = value;
        EXPECT_TRUE(to_json(run).at("target_ci").is_null());
        EXPECT_THAT(line_text(to_json(run)), AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
    }
}

TEST(Record, fixed_radius_and_a_path_without_layout_are_null) {
    CellResult cell = one_group().cells[0];
    EXPECT_TRUE(to_json(cell).at("params").at("overlap").is_null());
    EXPECT_TRUE(to_json(cell).at("params").at("layout").is_null());
    cell.params.overlap = 2.5;
    EXPECT_EQ(to_json(cell).at("params").at("overlap"), 2.5);
}

TEST(Record, unknown_keys_are_ignored_and_missing_or_wrong_ones_refused_with_their_place) {
    Json json = to_json(one_group());
    json["cells"][0]["colour"] = "blue";
    EXPECT_NO_THROW(from_json<GroupResult>(json, "f"));
    Json wrong = json;
    wrong["cells"][1]["samples"]["wall_ns"][2] = "fast";
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(wrong, "f:"); }),
                AllOf(StartsWith("f:/cells/1/samples/wall_ns/2: "), HasSubstr("whole number"), HasSubstr("string")));
    Json missing = json;
    missing["cells"][0]["params"].erase("width_px");
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(missing, "f:"); }),
                AllOf(StartsWith("f:/cells/0/params: "), HasSubstr("'width_px' is missing")));
    Json status = json;
    status["cells"][0]["status"] = "okay";
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(status, "f:"); }), HasSubstr("did you mean 'ok'"));
    Json large = json;
    large["cells"][0]["params"]["width_px"] = int64_t{1} << 40;
    EXPECT_THAT(input_error([&] { from_json<GroupResult>(large, "f:"); }), HasSubstr("out of range"));
}

TEST(Record, fingerprint_changes_with_what_changes_times) {
    const Environment environment = synthetic_environment();
    Environment other = environment;
    other.memory_bytes += 4096;
    EXPECT_EQ(environment_fingerprint(other), environment.fingerprint);
    EXPECT_EQ(environment_difference(environment, other), "");
    other.driver_variables["LP_NUM_THREADS"] = "1";
    other.cores = 4;
    EXPECT_NE(environment_fingerprint(other), environment.fingerprint);
    EXPECT_EQ(environment_difference(environment, other),
              R"(cores: 2 / 4, driver_variables: {"LP_NUM_THREADS":"2"} / {"LP_NUM_THREADS":"1"})");
}

TEST(Record, report_text_is_the_same_json_with_plain_lists_on_one_line) {
    const Json json = to_json(one_group());
    const std::string text = report_text(json);
    EXPECT_EQ(Json::parse(text), json);
    EXPECT_THAT(text, HasSubstr("\"round\": [0,1,2,3,4]"));
    EXPECT_EQ(text.back(), '\n');
    EXPECT_EQ(report_text({{"a", Json::array()}, {"b", {{"c", {1, 2}}}}}),
              "{\n \"a\": [],\n \"b\": {\n  \"c\": [1,2]\n }\n}\n");
    EXPECT_EQ(report_text("\xff"), "\"\uFFFD\"\n");
}

}  // namespace
}  // namespace lightsweep
