// Order statistics against numbers from tables, and the promise of an interval: it holds the truth as often as it says.
#include "bench/stats/quantile.h"

#include "bench/stats/block_bootstrap.h"
#include "tests/unit/stats/noise.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightsweep {
namespace {

std::vector<double> one_to(int n) {
    std::vector<double> values;
    // 37 has no common factor with the sizes used, so that this visits each value once, out of order.
    for (int i = 0; i < n; ++i) values.push_back(1 + (37 * i) % n);
    return values;
}

TEST(Quantile, InterpolatesAsTypeSeven) {
    const std::vector<double> v{40, 10, 30, 20};
    EXPECT_EQ(quantile(v, 0), 10);
    EXPECT_EQ(quantile(v, 1), 40);
    EXPECT_EQ(quantile(v, 0.5), 25);
    EXPECT_DOUBLE_EQ(quantile(v, 0.25), 17.5);  // position 0.75: 10 + 0.75 * 10
    EXPECT_DOUBLE_EQ(quantile(v, 0.9), 37);     // position 2.7: 30 + 0.7 * 10
    EXPECT_EQ(quantile(std::vector{5.0}, 0.3), 5);
}

TEST(Quantile, RisesWithTheFraction) {
    const auto v = autoregression(31, 0.5, 3);
    for (int i = 1; i <= 100; ++i) EXPECT_GE(quantile(v, i / 100.0), quantile(v, (i - 1) / 100.0)) << i;
}

TEST(Median, OfOddAndEvenCounts) {
    EXPECT_EQ(median(std::vector{3.0, 1.0, 2.0}), 2);
    EXPECT_EQ(median(std::vector{4.0, 1.0, 2.0, 3.0}), 2.5);
    EXPECT_EQ(median(std::vector{1.0, 1.0, 1.0, 1000.0}), 1);
}

TEST(MedianInterval, TakesTheRanksOfTheTables) {
    // Ranks of the 95 % sign-test interval as tabulated: n = 6: 1 and 6; 9: 2 and 8.
    for (const auto& [n, low, high] : {std::tuple{6, 1, 6}, {8, 1, 8}, {9, 2, 8}}) {
        const Interval interval = median_interval(one_to(n));
        EXPECT_EQ(interval.low, low) << n;
        EXPECT_EQ(interval.high, high) << n;
        EXPECT_EQ(interval.estimate, (n + 1) / 2.0);
    }
    // From 10 on the ranks hold for samples without autocorrelation, as these that alternate: n = 20: 6 and 15; 100:
    // 40, 61.
    for (const auto& [n, low, high] : {std::tuple{20, 6, 15}, {100, 40, 61}}) {
        std::vector<double> alternating;
        for (int i = 0; i < n; ++i) alternating.push_back(i % 2 == 0 ? 1 + i / 2 : n - i / 2);
        const Interval interval = median_interval(alternating);
        EXPECT_EQ(interval.low, low) << n;
        EXPECT_EQ(interval.high, high) << n;
    }
}

TEST(MedianInterval, IsUnboundedWhereTheSamplesCannotBoundIt) {
    for (int n = 1; n <= 5; ++n) {
        const Interval interval = median_interval(one_to(n));
        EXPECT_FALSE(interval.low || interval.high) << n;
        EXPECT_EQ(interval.estimate, (n + 1) / 2.0);
    }
    EXPECT_TRUE(median_interval(one_to(5), 0.9).low);  // 2 / 32 is below 10 %, not below 5 %
    // A hundred samples that change side once say no more than a few.
    std::vector<double> step(100, 1.0);
    std::fill(step.begin() + 50, step.end(), 2.0);
    EXPECT_FALSE(median_interval(step).low);
}

TEST(MedianInterval, IsWiderAtAHigherLevelAndForDependentSamples) {
    const auto width = [](const Interval& i) { return *i.high - *i.low; };
    const auto v = autoregression(200, 0.0, 1);
    EXPECT_LT(width(median_interval(v, 0.5)), width(median_interval(v, 0.95)));
    EXPECT_LT(width(median_interval(v, 0.95)), width(median_interval(v, 0.999)));
    // The same values, sorted in runs, follow each other more closely.
    auto runs = v;
    for (size_t i = 0; i < runs.size(); i += 20) std::sort(runs.begin() + i, runs.begin() + i + 20);
    EXPECT_LT(width(median_interval(v)), width(median_interval(runs)));
}

TEST(MedianInterval, MovesWithTheSamples) {
    const auto v = autoregression(60, 0.3, 5);
    auto moved = v;
    for (double& x : moved) x = 7 - 2 * x;  // turned round, stretched and shifted
    const Interval before = median_interval(v), after = median_interval(moved);
    EXPECT_DOUBLE_EQ(after.estimate, 7 - 2 * before.estimate);
    EXPECT_DOUBLE_EQ(*after.low, 7 - 2 * *before.high);
    EXPECT_DOUBLE_EQ(*after.high, 7 - 2 * *before.low);
}

struct Case {
    size_t count;
    double rho;
};

class Coverage : public ::testing::TestWithParam<Case> {
  protected:
    template <typename Estimator>
    double share_that_holds_zero(Estimator interval_of) const {
        constexpr int kTrials = 600;
        int holds = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            const auto samples = autoregression(GetParam().count, GetParam().rho, 1000 + static_cast<uint64_t>(trial));
            const Interval interval = interval_of(samples);
            holds += interval.low.value_or(-1e9) <= 0 && interval.high.value_or(1e9) >= 0;
        }
        return static_cast<double>(holds) / kTrials;
    }
};

TEST_P(Coverage, OfTheSignTestInterval) {
    const double share = share_that_holds_zero([](const auto& samples) { return median_interval(samples); });
    EXPECT_GE(share, 0.88);
    EXPECT_LE(share, 0.995);
}

TEST_P(Coverage, OfTheBlockBootstrap) {
    const double share = share_that_holds_zero(
        [](const auto& samples) { return block_median_interval(samples, block_length(samples)); });
    EXPECT_GE(share, 0.88);
    EXPECT_LE(share, 0.995);
}

INSTANTIATE_TEST_SUITE_P(Noise, Coverage,
                         ::testing::Values(Case{20, 0.0}, Case{30, 0.3}, Case{50, 0.5}, Case{120, 0.0}, Case{120, 0.3},
                                           Case{120, 0.5}, Case{250, 0.7}),
                         [](const auto& c) {
                             return std::to_string(c.param.count) + "_samples_rho_0_" +
                                    std::to_string(static_cast<int>(10 * c.param.rho + 0.5));
                         });

TEST(LevelForEach, IsBonferronis) {
    EXPECT_DOUBLE_EQ(level_for_each(0.95, 1), 0.95);
    EXPECT_DOUBLE_EQ(level_for_each(0.95, 5), 0.99);
    EXPECT_DOUBLE_EQ(level_for_each(0.9, 10), 0.99);
}

}  // namespace
}  // namespace lightsweep
