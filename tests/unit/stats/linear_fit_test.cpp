// The straight line through points: a textbook example and its limits.
#include "bench/stats/linear_fit.h"

#include <gtest/gtest.h>

#include <vector>

namespace lightsweep {
namespace {

TEST(LinearFit, MatchesAnscombesQuartet) {
    // Anscombe, "Graphs in Statistical Analysis", 1973, first set: y = 3.00 + 0.500 x, R^2 = 0.667.
    const std::vector<double> x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
    const std::vector<double> y{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
    const auto fit = linear_fit(x, y);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->slope, 0.500, 0.0005);
    EXPECT_NEAR(fit->intercept, 3.00, 0.005);
    EXPECT_NEAR(fit->r_squared, 0.667, 0.0005);
}

TEST(LinearFit, IsExactOnALine) {
    const auto fit = linear_fit(std::vector<double>{1, 2, 4}, std::vector<double>{-1, -3, -7});
    EXPECT_DOUBLE_EQ(fit->slope, -2);
    EXPECT_NEAR(fit->intercept, 1, 1e-12);
    EXPECT_DOUBLE_EQ(fit->r_squared, 1);
}

TEST(LinearFit, ExplainsNothingOfAConstant) {
    const auto fit = linear_fit(std::vector<double>{1, 2, 4}, std::vector<double>{5, 5, 5});
    EXPECT_EQ(fit->slope, 0);
    EXPECT_EQ(fit->r_squared, 0);
}

TEST(LinearFit, NeedsTwoPlaces) {
    EXPECT_FALSE(linear_fit({}, {}));
    EXPECT_FALSE(linear_fit(std::vector<double>{3, 3}, std::vector<double>{1, 2}));
}

}  // namespace
}  // namespace lightsweep
