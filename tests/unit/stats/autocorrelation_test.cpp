// What autocorrelation takes from a sample, against laws with a known answer.
#include "bench/stats/autocorrelation.h"

#include "bench/stats/block_bootstrap.h"
#include "bench/stats/quantile.h"
#include "tests/unit/stats/noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

TEST(EffectiveSampleSize, OfAnAutoregressionIsItsLaw) {
    // n (1 - rho) / (1 + rho)
    for (const double rho : {0.0, 0.3, 0.5, 0.8}) {
        const size_t n = 20000;
        const double expected = static_cast<double>(n) * (1 - rho) / (1 + rho);
        EXPECT_NEAR(effective_sample_size(autoregression(n, rho, 4)), expected, 0.12 * expected) << rho;
    }
}

TEST(EffectiveSampleSize, IsTheCountWhereNothingSpeaksAgainstIt) {
    EXPECT_EQ(effective_sample_size(std::vector<double>{1, 2, 3, 4, 5}), 5);
    EXPECT_EQ(effective_sample_size(std::vector<double>(40, 7.0)), 40);
    std::vector<double> alternating;
    for (int i = 0; i < 40; ++i) alternating.push_back(i % 2);
    EXPECT_EQ(effective_sample_size(alternating), 40);
    EXPECT_EQ(effective_sample_size(std::vector<double>{3}), 1);
}

TEST(EffectiveSampleSize, WorkedOutByHand) {
    // Five of 1, then five of -1: variance 1; the autocovariances times 10 at lags 0, 1, 2, ... are 10, 7, 4, 1, -2,
    // -5, ... (9 - k pairs less twice those across the step). Pairs of lags: 1.7, 0.5, then -0.7. Time: 2 (1.7 + 0.5) -
    // 1 = 3.4.
    const std::vector<double> step{1, 1, 1, 1, 1, -1, -1, -1, -1, -1};
    EXPECT_DOUBLE_EQ(effective_sample_size(step), 10 / 3.4);
}

TEST(EffectiveSampleSize, DoesNotChangeWithScaleShiftOrDirection) {
    const auto v = autoregression(200, 0.6, 9);
    std::vector<double> changed(v.rbegin(), v.rend());
    for (double& x : changed) x = 100 - 3 * x;
    EXPECT_NEAR(effective_sample_size(changed), effective_sample_size(v), 1e-9);
}

TEST(SidesOfMedian, AreSigns) {
    EXPECT_THAT(sides_of_median(std::vector<double>{5, 1, 3, 3, 9}), ::testing::ElementsAre(1, -1, 0, 0, 1));
}

TEST(BlockLength, FollowsTheDependenceAndTheCount) {
    std::vector<double> alternating;
    for (int i = 0; i < 60; ++i) alternating.push_back(i % 2);
    EXPECT_EQ(block_length(alternating), 1U);
    EXPECT_GT(block_length(autoregression(400, 0.8, 2)), block_length(autoregression(400, 0.3, 2)));
    EXPECT_GT(block_length(autoregression(4000, 0.5, 2)), block_length(autoregression(400, 0.5, 2)));
    for (size_t n = 2; n < 40; ++n) {
        const size_t block = block_length(autoregression(n, 0.95, n));
        EXPECT_GE(block, 1U);
        EXPECT_LE(block, n / 2);
    }
}

}  // namespace
}  // namespace lightsweep
