// The ratio of two arms: what it must not depend on, what it must find, and the words for it.
#include "bench/stats/ratio.h"

#include "tests/unit/stats/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lightsweep {
namespace {

struct Times {
    std::vector<double> a, b;
};

/// Two arms with a true ratio, on a machine whose speed wanders much more than the arms differ.
Times on_a_drifting_machine(size_t pairs, double ratio, double jitter, uint64_t seed) {
    const auto drift = autoregression(pairs, 0.9, seed);
    Random random(seed + 77);
    Times times;
    for (size_t i = 0; i < pairs; ++i) {
        const double speed = 5e6 * std::exp(0.3 * drift[i]);
        times.a.push_back(speed * ratio * std::exp(jitter * gaussian(random)));
        times.b.push_back(speed * std::exp(jitter * gaussian(random)));
    }
    return times;
}

TEST(RatioOfPairs, IsTheMedianOfTheRatios) {
    const auto ratio = ratio_of_pairs(std::vector<double>{2, 30, 8}, std::vector<double>{1, 10, 1});
    ASSERT_TRUE(ratio);
    EXPECT_DOUBLE_EQ(ratio->ratio.estimate, 3);
    EXPECT_FALSE(ratio->ratio.low || ratio->ratio.high);
    EXPECT_EQ(ratio->pairs, 3U);
    EXPECT_EQ(ratio->effective_count, 3);
}

TEST(RatioOfPairs, HasTheSignTestIntervalForFewPairs) {
    const std::vector<double> a{3, 2, 1, 6, 5, 4}, b(6, 1.0);
    const auto ratio = ratio_of_pairs(a, b);
    EXPECT_DOUBLE_EQ(*ratio->ratio.low, 1);
    EXPECT_DOUBLE_EQ(*ratio->ratio.high, 6);
    EXPECT_NEAR(ratio->ratio.estimate, std::sqrt(12.0), 1e-12);  // halfway between 3 and 4 in the logarithm
}

TEST(RatioOfPairs, CancelsTheDriftOfTheMachine) {
    const Times times = on_a_drifting_machine(60, 1.05, 0.01, 3);
    const auto paired = ratio_of_pairs(times.a, times.b)->ratio;
    EXPECT_NEAR(paired.estimate, 1.05, 0.01);
    EXPECT_GT(*paired.low, 1.03);
    EXPECT_LT(*paired.high, 1.07);
    // The same samples in the wrong pairs: the drift is back.
    auto shifted = times.b;
    std::rotate(shifted.begin(), shifted.begin() + 30, shifted.end());
    const auto unpaired = ratio_of_pairs(times.a, shifted)->ratio;
    EXPECT_GT(unpaired.high.value_or(1e9) - unpaired.low.value_or(0), 5 * (*paired.high - *paired.low));
}

TEST(RatioOfPairs, IsInvertedBySwappingTheArms) {
    for (const size_t pairs : {7U, 8U, 30U, 31U, 150U}) {
        const Times times = on_a_drifting_machine(pairs, 1.3, 0.2, pairs);
        const auto ab = ratio_of_pairs(times.a, times.b)->ratio;
        const auto ba = ratio_of_pairs(times.b, times.a)->ratio;
        EXPECT_NEAR(ab.estimate * ba.estimate, 1, 1e-12) << pairs;
        ASSERT_TRUE(ab.low && ab.high && ba.low && ba.high) << pairs;
        EXPECT_NEAR(*ab.low * *ba.high, 1, 1e-12) << pairs;
        EXPECT_NEAR(*ab.high * *ba.low, 1, 1e-12) << pairs;
    }
}

TEST(RatioOfPairs, DoesNotChangeWithTheUnitAndScalesWithOneArm) {
    Times times = on_a_drifting_machine(50, 0.8, 0.1, 5);
    const auto before = ratio_of_pairs(times.a, times.b)->ratio;
    for (double& v : times.a) v *= 1e-9;
    for (double& v : times.b) v *= 1e-9;
    const auto seconds = ratio_of_pairs(times.a, times.b)->ratio;
    EXPECT_NEAR(seconds.estimate, before.estimate, 1e-9);
    EXPECT_NEAR(*seconds.low, *before.low, 1e-9);
    for (double& v : times.a) v *= 2;
    const auto twice = ratio_of_pairs(times.a, times.b)->ratio;
    EXPECT_NEAR(twice.estimate, 2 * before.estimate, 1e-9);
    EXPECT_NEAR(*twice.high, 2 * *before.high, 1e-9);
}

TEST(RatioOfPairs, OfAnArmWithItselfIsOne) {
    const auto times = on_a_drifting_machine(40, 1, 0.1, 6).a;
    const auto ratio = ratio_of_pairs(times, times)->ratio;
    EXPECT_EQ(ratio.estimate, 1);
    EXPECT_EQ(ratio.low, 1);
    EXPECT_EQ(ratio.high, 1);
}

TEST(RatioOfPairs, IsWiderForManyComparisons) {
    const Times times = on_a_drifting_machine(80, 1.1, 0.1, 8);
    const auto one = ratio_of_pairs(times.a, times.b)->ratio;
    const auto each = ratio_of_pairs(times.a, times.b, level_for_each(0.95, 15))->ratio;
    EXPECT_LT(*each.low, *one.low);
    EXPECT_GT(*each.high, *one.high);
    EXPECT_EQ(each.estimate, one.estimate);
}

TEST(RatioOfPairs, HoldsTheTruthAsOftenAsItSays) {
    for (const size_t pairs : {8U, 24U, 60U}) {
        int holds = 0, bounded = 0;
        constexpr int kTrials = 500;
        for (uint64_t trial = 0; trial < kTrials; ++trial) {
            const Times times = on_a_drifting_machine(pairs, 1.2, 0.05, 100 + trial);
            const auto ratio = ratio_of_pairs(times.a, times.b)->ratio;
            holds += ratio.low.value_or(0) <= 1.2 && ratio.high.value_or(1e9) >= 1.2;
            bounded += ratio.low && ratio.high;
        }
        EXPECT_GE(holds, 0.88 * kTrials) << pairs;
        EXPECT_LE(holds, 0.995 * kTrials) << pairs;
        EXPECT_GE(bounded, 0.99 * kTrials) << pairs;
    }
}

TEST(RatioOfPairs, DoesNotExistForWhatIsNoTime) {
    const std::vector<double> good{1, 2};
    EXPECT_FALSE(ratio_of_pairs({}, {}));
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        EXPECT_FALSE(ratio_of_pairs(good, std::vector<double>{1, bad})) << bad;
        EXPECT_FALSE(ratio_of_pairs(std::vector<double>{bad, 1}, good)) << bad;
    }
}

struct VerdictCase {
    std::optional<double> low, high;
    double floor;
    std::string_view expected;
};

TEST(Verdict, FollowsFromTheWholeInterval) {
    const VerdictCase cases[] = {
        {0.8, 0.9, 0.02, "faster"},    {1.1, 1.2, 0.02, "slower"},       {0.99, 1.01, 0.02, "same"},
        {0.9, 1.1, 0.02, "ambiguous"}, {0.9, 0.985, 0.02, "ambiguous"},  // 1 / 1.02 = 0.9804
        {0.9, 0.98, 0.02, "faster"},   {1.015, 1.03, 0.02, "ambiguous"}, {0.9, 0.95, 0.2, "same"},
        {{}, 0.9, 0.02, "faster"},     {1.1, {}, 0.02, "slower"},        {{}, {}, 0.02, "ambiguous"},
        {{}, 1.01, 0.02, "ambiguous"}, {0.99, {}, 0.02, "ambiguous"},    {0.99, 0.999, 0.0, "faster"},
        {1.0, 1.0, 0.0, "same"},
    };
    for (const VerdictCase& c : cases)
        EXPECT_EQ(word(verdict({.estimate = 1, .low = c.low, .high = c.high}, c.floor)), c.expected)
            << c.low.value_or(-1) << " .. " << c.high.value_or(-1) << " floor " << c.floor;
}

TEST(Verdict, IsTurnedBySwappingTheArms) {
    for (double low = 0.7; low < 1.4; low += 0.037)
        for (double high = low; high < 1.4; high += 0.041) {
            const auto ab = verdict({.estimate = low, .low = low, .high = high}, 0.05);
            const auto ba = verdict({.estimate = 1 / low, .low = 1 / high, .high = 1 / low}, 0.05);
            const auto turned = ab == Verdict::faster ? Verdict::slower : ab == Verdict::slower ? Verdict::faster : ab;
            EXPECT_EQ(ba, turned) << low << " .. " << high;
        }
}

}  // namespace
}  // namespace lightsweep
