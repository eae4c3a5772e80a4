#include "bench/report/answers.h"

#include "synthetic.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kMs = 1e6;

struct PlantedArm {
    std::string layout;
    double time_ms = 1.0;
    double flip_mean = 0.0;
    double sigma = 0.01;  ///< of its frames
};

// All arms are `deferred`; every one is 10 % slower in every second round.
GroupResult planted_group(const std::vector<PlantedArm>& arms, int rounds = 100) {
    GroupResult group;
    group.group = "planted";
    uint64_t seed = 1;
    for (const auto& planted : arms) {
        SyntheticClock clock(seed++, rounds, planted.sigma, 0.0);
        CellResult cell = synthetic_cell(arm("deferred", planted.layout, 4), planted.time_ms * kMs, clock);
        for (size_t i = 0; i < cell.samples.count(); i += 2)
            cell.samples.wall_ns[i] = cell.samples.wall_ns[i] * 11 / 10;
        cell.error = synthetic_error(std::max(planted.flip_mean, 1e-9), 0.0);
        if (planted.flip_mean == 0.0) {
            cell.error->reference->display = synthetic_image_error({{"flip_mean", 0.0}, {"rmse", 0.0}});
            cell.error->flip_mean_low = cell.error->flip_mean_high = 0.0;
        }
        group.cells.push_back(std::move(cell));
    }
    return group;
}

std::string layout_of(const CellResult* cell) { return cell ? cell->params.layout : "none"; }

Answer cheapest(const GroupResult& group, double limit) {
    return cheapest_within(group, {.metric = "flip_mean", .limit = limit}, 0.01);
}

TEST(CheapestWithin, is_the_fastest_of_those_within_and_wins_by_the_ratio_of_times) {
    const auto group =
        planted_group({{"exact", 4.0, 0.0}, {"fine", 2.0, 0.004}, {"near", 2.5, 0.01}, {"rough", 1.0, 0.02}});
    const Answer answer = cheapest(group, 0.01);  // at the limit is within it
    EXPECT_EQ(layout_of(answer.arm), "fine");
    EXPECT_EQ(layout_of(answer.runner_up), "near");
    EXPECT_EQ(answer.ratio_of, "wall_ns");
    EXPECT_NEAR(answer.ratio->estimate, 0.8, 0.01);  // 2 / 2.5
    EXPECT_LT(*answer.ratio->low, 0.8);
    EXPECT_GT(*answer.ratio->high, 0.795);
    EXPECT_LT(*answer.ratio->high, 0.82);
    EXPECT_EQ(answer.verdict, "faster");
    EXPECT_EQ(answer.floor, 0.01);
    EXPECT_FALSE(answer.reason.has_value());
    EXPECT_THAT(answer.statement, AllOf(HasSubstr("flip_mean 0.01"), HasSubstr("deferred/fine/rgba16f"),
                                        HasSubstr("deferred/near/rgba16f"), HasSubstr("faster")));
    EXPECT_EQ(layout_of(cheapest(group, 1.0).arm), "rough");
    EXPECT_EQ(layout_of(cheapest(group, 0.001).arm), "exact");
}

TEST(CheapestWithin, does_not_hang_on_the_order_of_the_arms) {
    std::vector<PlantedArm> arms{{"a", 4.0, 0.0}, {"b", 2.0, 0.004}, {"c", 2.5, 0.01}};
    do {
        EXPECT_EQ(layout_of(cheapest(planted_group(arms), 0.01).arm), "b");
        EXPECT_EQ(layout_of(cheapest(planted_group(arms), 0.01).runner_up), "c");
    } while (std::ranges::next_permutation(arms, {}, &PlantedArm::layout).found);
}

TEST(CheapestWithin, judges_by_the_metric_asked_for) {
    const auto group = planted_group({{"fine", 2.0, 0.004}, {"rough", 1.0, 0.02}});
    EXPECT_EQ(layout_of(cheapest_within(group, {.metric = "rmse", .limit = 0.02}, 0.01).arm), "fine");  // rmse 2 x flip
    EXPECT_EQ(layout_of(cheapest_within(group, {.metric = "rmse", .limit = 0.04}, 0.01).arm), "rough");
}

TEST(CheapestWithin, arms_that_take_the_same_time_are_not_told_apart) {
    const auto group = planted_group({{"a", 2.0, 0.004}, {"b", 2.0, 0.004}});
    const Answer near = cheapest_within(group, {.metric = "flip_mean", .limit = 0.01}, 0.1);
    EXPECT_EQ(near.verdict, "same");
    const Answer unknown = cheapest_within(group, {.metric = "flip_mean", .limit = 0.01}, std::nullopt);
    EXPECT_EQ(unknown.verdict, "ambiguous");  // no floor, no verdict
    EXPECT_LE(unknown.ratio->estimate, 1.0);
}

TEST(CheapestWithin, frames_of_one_round_decide_between_the_first_two) {
    // Round by round b takes 0.9 of a's time but for two rounds, in which b alone met an interruption; a stopped early,
    // before the machine slowed down, so that its median is the smaller one.
    auto group = planted_group({{"a", 1.0, 0.0}, {"b", 1.0, 0.0}}, 12);
    Samples& a = group.cells[0].samples;
    Samples& b = group.cells[1].samples;
    a.wall_ns = {100, 100, 100, 100, 100, 100, 100};
    a.round.resize(a.wall_ns.size());
    b.wall_ns = {90, 90, 90, 90, 90, 500, 500, 180, 180, 180, 180, 180};
    const Answer answer = cheapest(group, 0.01);
    EXPECT_EQ(layout_of(answer.arm), "b");
    EXPECT_EQ(layout_of(answer.runner_up), "a");
    EXPECT_NEAR(answer.ratio->estimate, 0.9, 1e-12);
}

TEST(CheapestWithin, none_or_one_within) {
    const auto group = planted_group({{"fine", 2.0, 0.004}, {"rough", 1.0, 0.02}});
    const Answer one = cheapest(group, 0.01);
    EXPECT_EQ(layout_of(one.arm), "fine");
    EXPECT_EQ(one.runner_up, nullptr);
    EXPECT_FALSE(one.ratio.has_value());
    EXPECT_FALSE(one.verdict.has_value());
    EXPECT_THAT(one.statement, HasSubstr("no other arm"));
    const Answer none = cheapest(group, 0.001);
    EXPECT_EQ(none.arm, nullptr);
    EXPECT_THAT(none.reason.value(),
                AllOf(HasSubstr("no arm is within flip_mean 0.001"), HasSubstr("fine"), Not(HasSubstr("rough"))));
    EXPECT_EQ(none.statement, none.reason);
}

TEST(CheapestWithin, arms_without_an_error_or_a_time_do_not_take_part) {
    auto group = planted_group({{"failed", 1.0, 0.0}, {"unknown", 1.0, 0.0}, {"fine", 2.0, 0.004}});
    group.cells[0].status = CellStatus::error;
    group.cells[1].error->reference.reset();
    EXPECT_EQ(layout_of(cheapest(group, 0.01).arm), "fine");
    group.cells.pop_back();
    EXPECT_THAT(cheapest(group, 0.01).reason.value(), HasSubstr("no arm has"));
    EXPECT_THAT(most_exact_within(group, kMs).reason.value(), HasSubstr("no arm has"));
}

TEST(MostExactWithin, is_the_smallest_error_of_those_within_and_wins_by_the_ratio_of_errors) {
    const auto group =
        planted_group({{"exact", 9.0, 0.0}, {"fine", 2.0, 0.004}, {"near", 2.5, 0.01}, {"rough", 1.0, 0.02}});
    const Answer answer = most_exact_within(group, 5.0 * kMs);
    EXPECT_EQ(layout_of(answer.arm), "fine");
    EXPECT_EQ(layout_of(answer.runner_up), "near");
    EXPECT_EQ(answer.ratio_of, "reference.display.flip_mean");
    EXPECT_DOUBLE_EQ(answer.ratio->estimate, 0.4);
    EXPECT_FALSE(answer.ratio->low || answer.ratio->high);  // errors are exact
    EXPECT_EQ(answer.verdict, "more_exact");
    EXPECT_FALSE(answer.floor.has_value());
    EXPECT_THAT(answer.uncertain, IsEmpty());
    EXPECT_THAT(answer.statement,
                AllOf(HasSubstr("on this picture"), HasSubstr("within 5 ms"), HasSubstr("deferred/fine/rgba16f"),
                      HasSubstr("flip_mean 0.004 [0.0036, 0.0044]"), HasSubstr("more_exact")));
}

TEST(MostExactWithin, a_smaller_error_decides_even_where_the_intervals_meet_and_equal_ones_go_to_the_faster_arm) {
    const auto near = planted_group({{"a", 1.0, 0.011}, {"b", 2.0, 0.010}});
    EXPECT_EQ(layout_of(most_exact_within(near, 5.0 * kMs).arm), "b");
    EXPECT_EQ(most_exact_within(near, 5.0 * kMs).verdict, "more_exact");
    const auto equal = planted_group({{"slow", 2.0, 0.01}, {"quick", 1.0, 0.01}});
    const Answer answer = most_exact_within(equal, 5.0 * kMs);
    EXPECT_EQ(layout_of(answer.arm), "quick");
    EXPECT_EQ(answer.ratio->estimate, 1.0);
    EXPECT_EQ(answer.verdict, "same");
}

TEST(MostExactWithin, no_error_at_all_beats_every_error) {
    const auto with_control = planted_group({{"rough", 1.0, 0.02}, {"control", 2.0, 0.0}});
    const Answer answer = most_exact_within(with_control, 5.0 * kMs);
    EXPECT_EQ(layout_of(answer.arm), "control");
    EXPECT_EQ(answer.ratio->estimate, 0.0);
    EXPECT_EQ(answer.verdict, "more_exact");
    const auto two_exact = planted_group({{"a", 1.0, 0.0}, {"b", 2.0, 0.0}});
    const Answer both = most_exact_within(two_exact, 5.0 * kMs);
    EXPECT_EQ(layout_of(both.arm), "a");
    EXPECT_FALSE(both.ratio.has_value());  // 0 over 0
    EXPECT_EQ(both.verdict, "same");
}

TEST(MostExactWithin, a_time_that_may_be_over_the_limit_is_uncertain) {
    // Half of the frames take 2 ms and half 2.2 ms: the median's interval goes from the one to the other.
    const auto group = planted_group({{"wide", 2.0, 0.001}, {"quick", 1.0, 0.02}, {"slow", 9.0, 0.0}});
    const Answer answer = most_exact_within(group, 2.1 * kMs);
    EXPECT_EQ(layout_of(answer.arm), "quick");
    EXPECT_THAT(answer.uncertain, ElementsAre(&group.cells[0]));
    EXPECT_THAT(answer.statement,
                AllOf(HasSubstr("uncertain"), HasSubstr("deferred/wide/rgba16f"), Not(HasSubstr("slow"))));
    EXPECT_EQ(layout_of(most_exact_within(group, 3.0 * kMs).arm), "wide");
}

TEST(MostExactWithin, uncertain_arms_that_would_not_win_are_kept_but_not_named) {
    const auto group = planted_group({{"wide", 2.0, 0.02}, {"quick", 1.0, 0.001}});
    const Answer answer = most_exact_within(group, 2.1 * kMs);
    EXPECT_EQ(layout_of(answer.arm), "quick");
    EXPECT_THAT(answer.uncertain, ElementsAre(&group.cells[0]));
    EXPECT_THAT(answer.statement, Not(HasSubstr("uncertain")));
}

TEST(MostExactWithin, too_few_frames_for_an_interval_leave_every_arm_uncertain) {
    const auto group = planted_group({{"a", 1.0, 0.01}, {"b", 1.0, 0.02}, {"c", 1.0, 0.03}, {"d", 1.0, 0.04}}, 2);
    const Answer answer = most_exact_within(group, 9.0 * kMs);
    EXPECT_EQ(answer.arm, nullptr);
    EXPECT_EQ(answer.uncertain.size(), 4U);
    EXPECT_THAT(most_exact_within(group, 0.5 * kMs).uncertain, IsEmpty());  // every median is over
    EXPECT_THAT(answer.reason.value(),
                AllOf(HasSubstr("/a/"), HasSubstr("/c/"), Not(HasSubstr("/d/")), HasSubstr("1 more")));
}

TEST(MostExactWithin, none_within) {
    const auto group = planted_group({{"wide", 2.0, 0.001}, {"slow", 9.0, 0.0}});
    const Answer over = most_exact_within(group, 1.0 * kMs);
    EXPECT_EQ(over.arm, nullptr);
    EXPECT_THAT(over.reason.value(), AllOf(HasSubstr("within 1 ms"), HasSubstr("the fastest is deferred/wide")));
    const Answer unsure = most_exact_within(group, 2.1 * kMs);
    EXPECT_EQ(unsure.arm, nullptr);
    EXPECT_THAT(unsure.reason.value(), AllOf(HasSubstr("uncertain"), HasSubstr("deferred/wide")));
}

TEST(AnswerJson, says_the_question_and_is_null_where_nothing_is) {
    const auto group = planted_group({{"fine", 2.0, 0.004}, {"rough", 1.0, 0.02}});
    const Json one = to_json(cheapest(group, 0.01));
    EXPECT_EQ(one.at("question"), (Json{{"metric", "flip_mean"}, {"limit", 0.01}}));
    EXPECT_EQ(one.at("arm"), group.cells[0].id);
    for (const char* key : {"runner_up", "ratio", "low", "high", "verdict", "reason"}) {
        EXPECT_TRUE(one.at(key).is_null()) << key;
    }
    EXPECT_EQ(one.at("uncertain"), Json::array());
    const Json none = to_json(most_exact_within(group, 1.0));
    EXPECT_EQ(none.at("question"), (Json{{"max_time_ns", 1.0}}));
    EXPECT_TRUE(none.at("arm").is_null());
    EXPECT_TRUE(none.at("reason").is_string());
}

}  // namespace
}  // namespace lightsweep
