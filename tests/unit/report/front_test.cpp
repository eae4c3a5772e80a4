#include "bench/report/front.h"

#include "synthetic.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace lightsweep {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr FrontState kFront = FrontState::front, kPerhaps = FrontState::perhaps, kDominated = FrontState::dominated;
constexpr double kFloor = 0.02;

/// Round i takes 1 ms times the drift of the round times factors[i % size].
struct HandMadeArm {
    std::vector<double> factors;
    double flip_mean = 0.0;
};

GroupResult hand_made_group(const std::vector<HandMadeArm>& arms, size_t rounds) {
    constexpr double kDrift[] = {1.0, 1.3, 1.1, 2.0,
                                 1.7, 1.2, 1.4};  // all arms share it: the ratios know nothing of it
    GroupResult group;
    for (const auto& [factors, flip_mean] : arms) {
        CellResult cell;
        for (size_t i = 0; i < rounds; ++i) {
            cell.samples.round.push_back(static_cast<int64_t>(i));
            cell.samples.wall_ns.push_back(std::llround(1e6 * kDrift[i % 7] * factors[i % factors.size()]));
        }
        cell.error = synthetic_error(flip_mean, 0.0);
        group.cells.push_back(std::move(cell));
    }
    return group;
}

std::vector<FrontState> states_of(const std::vector<HandMadeArm>& arms, size_t rounds = 21,
                                  std::optional<double> floor = kFloor) {
    const GroupResult group = hand_made_group(arms, rounds);
    return front_states(time_error_points(group, kErrorMetric), floor);
}

TEST(FrontStates, whoever_is_surely_slower_and_no_more_exact_is_dominated) {
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {{1.1}, 0.01}, {{1.2}, 0.02}, {{1.3}, 0.005}}),
                ElementsAre(kFront, kDominated, kDominated, kFront));
}

TEST(FrontStates, a_slower_median_alone_beats_nobody) {
    // In 14 of 35 rounds the second arm is the faster one.
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {{1.05, 0.8, 1.3, 0.9, 1.2}, 0.02}}, 35), ElementsAre(kFront, kPerhaps));
}

TEST(FrontStates, the_same_time_decides_only_with_a_smaller_error) {
    const std::vector<double> slower_within_the_floor{1.01};
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {slower_within_the_floor, 0.01}}), ElementsAre(kFront, kPerhaps));
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {slower_within_the_floor, 0.02}}), ElementsAre(kFront, kDominated));
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {slower_within_the_floor, 0.02}}, 21, 0.001), ElementsAre(kFront, kDominated))
        << "above a lower floor it is surely slower";
}

TEST(FrontStates, without_a_noise_floor_nobody_is_surely_beaten) {
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {{2.0}, 0.02}}, 21, std::nullopt), ElementsAre(kFront, kPerhaps));
}

TEST(FrontStates, all_verdicts_hold_together) {
    // Seven rounds of one sign come by chance once in 64 times: enough for one pair at 95 %, not for six.
    std::vector<HandMadeArm> arms{{{1.0, 1.01, 0.99}, 0.01}, {{2.0}, 0.02}};
    EXPECT_THAT(states_of(arms, 7), ElementsAre(kFront, kDominated));
    arms.push_back({{3.0}, 0.03});
    arms.push_back({{4.0}, 0.04});
    EXPECT_THAT(states_of(arms, 7), ElementsAre(kFront, kPerhaps, kPerhaps, kPerhaps));
    EXPECT_THAT(states_of(arms, 14), ElementsAre(kFront, kDominated, kDominated, kDominated));
}

TEST(FrontStates, arms_equal_in_both_are_on_the_front_together) {
    EXPECT_THAT(states_of({{{1.0}, 0.01}, {{1.0}, 0.01}}), Each(kFront));
    EXPECT_THAT(states_of({{{1.0}, 0.01}}), Each(kFront));
    EXPECT_THAT(states_of({}), ElementsAre());
}

TEST(FrontStates, do_not_hang_on_the_order_of_the_arms) {
    std::vector<HandMadeArm> arms{{{1.1}, 0.02}, {{1.12, 1.0, 1.3}, 0.025}, {{1.0}, 0.03}, {{1.2}, 0.04}};
    do {
        const auto states = states_of(arms);
        for (size_t i = 0; i < arms.size(); ++i) {
            const double error = arms[i].flip_mean;
            EXPECT_EQ(states[i], error == 0.04 ? kDominated : error == 0.025 ? kPerhaps : kFront) << error;
        }
    } while (std::ranges::next_permutation(arms, {}, &HandMadeArm::flip_mean).found);
}

}  // namespace
}  // namespace lightsweep
