// The computed bootstrap distribution against one that was simulated, and against a case small enough to count by hand.
#include "bench/stats/block_bootstrap.h"

#include "tests/unit/stats/noise.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightsweep {
namespace {

TEST(BlockMedianInterval, CountsEveryResampleOfThreeSamples) {
    // Blocks of one of {1, 2, 3}: 27 resamples, of which 7 have the median 1 (two ones or more), 13 have 2, 7 have 3.
    // A level whose expanded tail lies under 7/27 keeps the ends, a lower level gives them up.
    const std::vector<double> v{2, 3, 1};
    EXPECT_EQ(block_median_interval(v, 1, 0.9).low, 1);
    EXPECT_EQ(block_median_interval(v, 1, 0.9).high, 3);
    EXPECT_EQ(block_median_interval(v, 1, 0.1).low, 2);
    EXPECT_EQ(block_median_interval(v, 1, 0.1).high, 2);
}

TEST(BlockMedianInterval, AgreesWithASimulation) {
    const size_t n = 47, block = 6;
    const auto v = autoregression(n, 0.5, 21);
    Random random(5);
    std::vector<double> medians;
    for (int i = 0; i < 20000; ++i) {
        std::vector<double> resample;
        while (resample.size() < n) {
            const size_t start = random.index(n);
            for (size_t k = 0; k < block && resample.size() < n; ++k) resample.push_back(v[(start + k) % n]);
        }
        medians.push_back(median(resample));
    }
    // n / block = 7.83 blocks: t at 0.975 and 6.83 degrees is 2.377, times sqrt(7.83 / 6.83) is 2.545, a tail of
    // 0.00547.
    const Interval computed = block_median_interval(v, block, 0.95);
    const auto share_below = [&](double x) {
        return static_cast<double>(std::ranges::count_if(medians, [&](double m) { return m < x; })) / 20000;
    };
    const auto share_above = [&](double x) {
        return static_cast<double>(std::ranges::count_if(medians, [&](double m) { return m > x; })) / 20000;
    };
    auto sorted = v;
    std::ranges::sort(sorted);
    EXPECT_LE(share_below(*computed.low), 0.00547 + 0.002);
    EXPECT_GE(share_below(*std::ranges::upper_bound(sorted, *computed.low)), 0.00547 - 0.002);
    EXPECT_LE(share_above(*computed.high), 0.00547 + 0.002);
    EXPECT_GE(share_above(*std::prev(std::ranges::lower_bound(sorted, *computed.high))), 0.00547 - 0.002);
}

TEST(BlockMedianInterval, HoldsItsEstimateAndShrinksWithTheCount) {
    double previous = 1e9;
    for (const size_t n : {20U, 80U, 320U}) {
        const auto v = autoregression(n, 0.3, 8);
        const Interval interval = block_median_interval(v, block_length(v));
        EXPECT_LE(*interval.low, interval.estimate);
        EXPECT_GE(*interval.high, interval.estimate);
        EXPECT_LT(*interval.high - *interval.low, previous);
        previous = *interval.high - *interval.low;
    }
}

TEST(BlockMedianInterval, OfEqualSamplesIsAPoint) {
    const Interval interval = block_median_interval(std::vector<double>(30, 4.0), 3);
    EXPECT_EQ(interval.low, 4);
    EXPECT_EQ(interval.estimate, 4);
    EXPECT_EQ(interval.high, 4);
}

}  // namespace
}  // namespace lightsweep
