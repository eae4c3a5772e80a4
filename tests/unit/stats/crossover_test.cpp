// Where two laws of cost cross, on laws whose crossing is known.
#include "bench/stats/crossover.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lightsweep {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<double> kLights{1, 4, 16, 64, 256, 1024};

/// The ratio (lights / at)^power: straight in the logarithms, 1 at `at`; its ends are `spread` times less and more.
std::vector<Interval> power_law(const std::vector<double>& lights, double at, double power, double spread) {
    std::vector<Interval> ratios;
    for (const double n : lights) {
        const double r = std::pow(n / at, power);
        ratios.push_back({.estimate = r, .low = r / spread, .high = r * spread});
    }
    return ratios;
}

std::vector<Interval> ratios_of(std::initializer_list<double> estimates, double spread) {
    std::vector<Interval> ratios;
    for (const double r : estimates) ratios.push_back({.estimate = r, .low = r / spread, .high = r * spread});
    return ratios;
}

TEST(Crossover, IsExactOnAPowerLaw) {
    for (const double at : {1.7, 16.0, 37.0, 800.0})
        for (const double power : {0.3, -0.3, 1.0}) {
            const auto crossover = find_crossover(kLights, power_law(kLights, at, power, 1.1), "forward", "deferred");
            ASSERT_TRUE(crossover.lights) << at << " " << power << " " << crossover.statement;
            EXPECT_NEAR(crossover.lights->estimate, at, 1e-9 * at);
            EXPECT_THAT(crossover.statement,
                        HasSubstr(power > 0 ? "forward is faster below" : "deferred is faster below"));
        }
}

TEST(Crossover, HasTheIntervalOfTheLowAndHighCurves) {
    // ratio * 1.1 = 1 at 37 * 1.1^(-1 / 0.3), ratio / 1.1 = 1 at 37 * 1.1^(1 / 0.3).
    for (const double power : {0.3, -0.3}) {
        const auto crossover = find_crossover(kLights, power_law(kLights, 37, power, 1.1), "a", "b");
        EXPECT_NEAR(*crossover.lights->low, 37 / std::pow(1.1, 1 / 0.3), 1e-9);
        EXPECT_NEAR(*crossover.lights->high, 37 * std::pow(1.1, 1 / 0.3), 1e-9);
    }
}

TEST(Crossover, DoesNotChangeWhenTheArmsSwapOrPointsAreAddedOnTheLine) {
    const auto crossover = find_crossover(kLights, power_law(kLights, 37, 0.5, 1.2), "a", "b");
    const auto swapped = find_crossover(kLights, power_law(kLights, 37, -0.5, 1.2), "b", "a");
    EXPECT_EQ(crossover.statement, swapped.statement);
    EXPECT_NEAR(*crossover.lights->low, *swapped.lights->low, 1e-9);
    const std::vector<double> more{1, 2, 4, 8, 16, 30, 37, 50, 64, 100, 256, 1024};
    const auto denser = find_crossover(more, power_law(more, 37, 0.5, 1.2), "a", "b");
    EXPECT_NEAR(denser.lights->estimate, 37, 1e-6);
    EXPECT_NEAR(*denser.lights->low, *crossover.lights->low, 1e-9);
    EXPECT_NEAR(*denser.lights->high, *crossover.lights->high, 1e-9);
}

TEST(Crossover, TakesZeroLightsOnAShiftedScale) {
    // log2(1 + lights) = 0, 1, 2: halfway between 1 and 3 lights stands 2^1.5 - 1.
    const auto crossover = find_crossover(std::vector<double>{0, 1, 3}, ratios_of({0.25, 0.5, 2}, 1.01), "a", "b");
    ASSERT_TRUE(crossover.lights);
    EXPECT_NEAR(crossover.lights->estimate, std::pow(2, 1.5) - 1, 1e-12);
}

TEST(Crossover, LiesOnAMeasuredCountWhereTheRatioIsOne) {
    const auto crossover = find_crossover(std::vector<double>{1, 8, 64}, ratios_of({0.5, 1, 2}, 1.1), "a", "b");
    EXPECT_DOUBLE_EQ(crossover.lights->estimate, 8);
}

TEST(Crossover, SaysWhoIsFasterThroughout) {
    const auto slower = find_crossover(kLights, ratios_of({2, 2, 3, 4, 5, 6}, 1.1), "forward", "deferred");
    EXPECT_FALSE(slower.lights);
    EXPECT_EQ(slower.statement, "deferred is faster at every light count measured");
    const auto faster = find_crossover(kLights, ratios_of({0.5, 0.5, 0.4, 0.5, 0.6, 0.7}, 1.1), "forward", "deferred");
    EXPECT_EQ(faster.statement, "forward is faster at every light count measured");
}

TEST(Crossover, IsNotMadeFromNoise) {
    // Changes sign within the noise at few lights, clear at many: no crossing, and no claim about the noisy part.
    const auto noisy = find_crossover(kLights, ratios_of({0.99, 1.01, 0.99, 0.9, 0.8, 0.7}, 1.05), "a", "b");
    EXPECT_FALSE(noisy.lights);
    EXPECT_EQ(noisy.statement, "a is faster at every light count where the difference exceeds the noise");
    const auto none = find_crossover(kLights, ratios_of({0.99, 1.01, 0.99, 1.01, 1.02, 0.99}, 1.05), "a", "b");
    EXPECT_FALSE(none.lights);
    EXPECT_EQ(none.statement, "a and b cannot be told apart at any light count measured");
}

TEST(Crossover, SeesThroughNoiseAroundTheTrueOne) {
    // The estimate passes 1 three times, the evidence once: between 4 and 256 lights.
    const auto crossover = find_crossover(kLights, ratios_of({0.5, 0.7, 1.01, 1 / 1.01, 1.4, 2}, 1.05), "a", "b");
    ASSERT_TRUE(crossover.lights);
    EXPECT_NEAR(crossover.lights->estimate, 32,
                1e-9);  // the middle one, halfway from 16 to 64
    EXPECT_GT(*crossover.lights->low, 4);
    EXPECT_LT(*crossover.lights->high, 256);
    EXPECT_LT(*crossover.lights->low, *crossover.lights->high);
}

TEST(Crossover, StaysOpenWhereTheSweepEndsTooSoon) {
    const auto above = find_crossover(kLights, ratios_of({0.5, 0.6, 0.7, 0.8, 0.95, 1.02}, 1.06), "a", "b");
    ASSERT_TRUE(above.lights);
    EXPECT_TRUE(above.lights->low);
    EXPECT_FALSE(above.lights->high);
    EXPECT_THAT(above.statement, HasSubstr("b above (within the noise)"));
    const auto below = find_crossover(kLights, ratios_of({0.98, 1.05, 1.2, 1.3, 1.4, 1.5}, 1.06), "a", "b");
    ASSERT_TRUE(below.lights);
    EXPECT_FALSE(below.lights->low);
    EXPECT_TRUE(below.lights->high);
    EXPECT_THAT(below.statement, HasSubstr("a is faster below about"));
    EXPECT_THAT(below.statement, Not(HasSubstr("b above (within")));
}

TEST(Crossover, ReportsAWayThereAndBack) {
    const auto back = find_crossover(kLights, ratios_of({0.5, 0.7, 2, 2, 0.7, 0.5}, 1.05), "a", "b");
    EXPECT_FALSE(back.lights);
    EXPECT_EQ(back.statement, "a is faster at both ends, b between 4 and 256 lights");
}

TEST(Crossover, BearsUnboundedRatios) {
    auto ratios = power_law(kLights, 37, 0.5, 1.1);
    ratios[2].high = std::nullopt;  // 16 lights: clear before, now not; the interval begins at 4
    ratios[3].low = std::nullopt;   // 64 lights
    const auto crossover = find_crossover(kLights, ratios, "a", "b");
    ASSERT_TRUE(crossover.lights);
    EXPECT_NEAR(crossover.lights->estimate, 37, 1e-9);
    EXPECT_NEAR(*crossover.lights->low, 4, 1e-9);
    EXPECT_NEAR(*crossover.lights->high, 256, 1e-9);
}

TEST(Crossover, NeedsTwoLightCounts) {
    EXPECT_FALSE(find_crossover({}, {}, "a", "b").lights);
    const auto one = find_crossover(std::vector<double>{16}, ratios_of({0.5}, 1.1), "a", "b");
    EXPECT_FALSE(one.lights);
    EXPECT_THAT(one.statement, HasSubstr("two light counts"));
}

}  // namespace
}  // namespace lightsweep
