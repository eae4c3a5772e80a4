// The order of turns is balanced: in place, in predecessor, and against a drift.
#include "bench/stats/schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace lightsweep {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAreArray;

TEST(Schedule, IsABBAForTwo) {
    EXPECT_EQ(rounds_per_cycle(2), 2U);
    EXPECT_THAT(schedule(2, 0), ElementsAre(0, 1));
    EXPECT_THAT(schedule(2, 1), ElementsAre(1, 0));
    EXPECT_THAT(schedule(2, 2), ElementsAre(0, 1));
}

TEST(Schedule, StartsWithWilliamsRow) { EXPECT_THAT(schedule(6, 0), ElementsAre(0, 1, 5, 2, 4, 3)); }

class Design : public ::testing::TestWithParam<size_t> {
  protected:
    const size_t arms = GetParam();
    const size_t rounds = rounds_per_cycle(arms);
};

TEST_P(Design, VisitsEveryArmOncePerRound) {
    std::vector<size_t> all(arms);
    for (size_t i = 0; i < arms; ++i) all[i] = i;
    for (size_t round = 0; round < 3 * rounds; ++round)
        EXPECT_THAT(schedule(arms, round), UnorderedElementsAreArray(all)) << round;
}

TEST_P(Design, PutsEveryArmEquallyOftenInEveryPlace) {
    std::map<std::pair<size_t, size_t>, size_t> seen;
    for (size_t round = 0; round < rounds; ++round) {
        const auto order = schedule(arms, round);
        for (size_t place = 0; place < arms; ++place) ++seen[{order[place], place}];
    }
    EXPECT_EQ(seen.size(), arms * arms);
    EXPECT_THAT(seen, Each(Pair(::testing::_, rounds / arms)));
}

TEST_P(Design, LetsEveryArmFollowEveryOtherEquallyOften) {
    std::map<std::pair<size_t, size_t>, size_t> seen;
    for (size_t round = 0; round < rounds; ++round) {
        const auto order = schedule(arms, round);
        for (size_t place = 1; place < arms; ++place) ++seen[{order[place - 1], order[place]}];
    }
    EXPECT_EQ(seen.size(), arms * (arms - 1));
    EXPECT_THAT(seen, Each(Pair(::testing::_, rounds / arms)));
}

TEST_P(Design, CancelsALinearDriftInEveryTwoRounds) {
    if (arms == 1) return;  // has no second round to cancel with
    for (size_t round = 0; round < rounds; round += 2) {
        std::vector<size_t> time_of(arms);
        for (size_t place = 0; place < arms; ++place) {
            time_of[schedule(arms, round)[place]] += place;
            time_of[schedule(arms, round + 1)[place]] += arms + place;
        }
        EXPECT_THAT(time_of, Each(2 * arms - 1)) << round;
    }
}

INSTANTIATE_TEST_SUITE_P(Arms, Design, ::testing::Range<size_t>(1, 13));

}  // namespace
}  // namespace lightsweep
