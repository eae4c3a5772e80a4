// Rounding to few bits, and sums in them: numbers worked out by hand.
#include "bench/stress/rounding_law.h"

#include "renderer/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace lightsweep {
namespace {

constexpr Rounding kNearest = Rounding::nearest, kTruncate = Rounding::truncate;

// With 3 bits: 8, 9, ... 15, 16, 18, 20, ...
TEST(Rounded, ToThreeBitsByHand) {
    EXPECT_EQ(rounded(9.4, 3, kNearest), 9.0);
    EXPECT_EQ(rounded(9.6, 3, kNearest), 10.0);
    EXPECT_EQ(rounded(9.6, 3, kTruncate), 9.0);
    EXPECT_EQ(rounded(17.5, 3, kNearest), 18.0);
    EXPECT_EQ(rounded(17.5, 3, kTruncate), 16.0);
    EXPECT_EQ(rounded(15.9, 3, kNearest), 16.0) << "up into the next binade";
    EXPECT_EQ(rounded(0.0, 3, kNearest), 0.0);
    EXPECT_EQ(rounded(-9.6, 3, kTruncate), -9.0) << "towards zero";
}

TEST(Rounded, TiesGoToEven) {
    EXPECT_EQ(rounded(8.5, 3, kNearest), 8.0);
    EXPECT_EQ(rounded(9.5, 3, kNearest), 10.0);
    EXPECT_EQ(rounded(17.0, 3, kNearest), 16.0);
    EXPECT_EQ(rounded(19.0, 3, kNearest), 20.0);
}

// What the hardware does in 24 bits, and what the format says of its own constants.
TEST(Rounded, WithTwentyThreeBitsIsSinglePrecision) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const double value = std::exp(random.uniform(-60.0, 60.0));
        EXPECT_EQ(rounded(value, 23, kNearest), static_cast<double>(static_cast<float>(value)));
    }
}

TEST(FloatChannel, EndsAreThoseOfTheSpecification) {
    const FloatChannel half = coarsest_channel(gl::Format::RGBA16F);
    EXPECT_EQ(half.mantissa_bits, 10);
    EXPECT_EQ(half.largest, 65504.0);
    EXPECT_EQ(half.epsilon(), 0x1p-10);
    const FloatChannel blue = coarsest_channel(gl::Format::R11G11B10F);
    EXPECT_EQ(blue.mantissa_bits, 5);
    EXPECT_EQ(blue.largest, 64512.0);
    EXPECT_FALSE(blue.has_sign);
    EXPECT_EQ(coarsest_channel(gl::Format::RGBA32F).largest, static_cast<double>(std::numeric_limits<float>::max()));
}

// Ones are counted exactly up to 2^(bits + 1); there half of a step is a tie, and goes to the even number: no further.
TEST(RoundedSum, OfOnesStopsWhereTheStepIsTwo) {
    const std::vector<double> ones(5000, 1.0);
    EXPECT_EQ(rounded_sum(std::span(ones).first(2048), 10, kNearest), 2048.0);
    EXPECT_EQ(rounded_sum(ones, 10, kNearest), 2048.0);
    EXPECT_EQ(rounded_sum(ones, 10, kTruncate), 2048.0);
    EXPECT_EQ(rounded_sum(ones, 5, kNearest), 64.0);
    EXPECT_EQ(rounded_sum(ones, 23, kNearest), 5000.0);
}

// 3 bits and 0.75: 0.75, 1.5, 2.25, 3; 3.75; then steps of 1/2: 4.5; 5.25 is half-way and goes to 5, the even one (as
// 10/2); 5.75 is half-way between 5.5 and 6, and goes to 6.
TEST(RoundedSum, StepByStep) {
    const std::vector<double> values(8, 0.75);
    const double nearest[] = {0.75, 1.5, 2.25, 3.0, 3.75, 4.5, 5.0, 6.0};
    const double truncated[] = {0.75, 1.5, 2.25, 3.0, 3.75, 4.5, 5.0, 5.5};
    for (size_t n = 1; n <= values.size(); ++n) {
        EXPECT_EQ(rounded_sum(std::span(values).first(n), 3, kNearest), nearest[n - 1]) << n;
        EXPECT_EQ(rounded_sum(std::span(values).first(n), 3, kTruncate), truncated[n - 1]) << n;
    }
}

TEST(RoundedSum, SmallOnesCountOnlyWhenTheyComeFirst) {
    std::vector<double> values(1024, 0x1p-12);  // together 1/4, each a quarter of half's step at 1
    values.push_back(1.0);
    EXPECT_EQ(rounded_sum(values, 10, kNearest), 1.25);
    std::vector<double> falling(values.rbegin(), values.rend());
    EXPECT_EQ(rounded_sum(falling, 10, kNearest), 1.0);
}

// N - 1 additions, each off by half a step or a whole one of a sum that is no larger than the last.
TEST(RoundedSum, StaysWithinItsWorstCase) {
    Random random(7);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> values;
        double exact = 0.0;
        for (int i = 0; i < 60; ++i) {
            values.push_back(rounded(std::exp(random.uniform(-4.0, 0.0)), 10, kTruncate));
            exact += values.back();
        }
        const double nearest = rounded_sum(values, 10, kNearest), truncated = rounded_sum(values, 10, kTruncate);
        EXPECT_LE(std::abs(nearest - exact), 59 * 0x1p-11 * 1.03 * exact);
        EXPECT_LE(truncated, exact);
        EXPECT_GE(truncated, exact * (1.0 - 59 * 0x1p-10));
    }
}

}  // namespace
}  // namespace lightsweep
