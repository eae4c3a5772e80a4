#include "bench/stats/nonnegative_fit.h"

#include <gmock/gmock.h>

#include <random>

namespace lightsweep {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

TEST(NonnegativeFit, FindsTheCoefficientsOfAnExactCombination) {
    // b = 3 * (1, 1, 1, 1) + 0.5 * (1, 2, 4, 8)
    const std::vector<std::vector<double>> rows{{1, 1}, {1, 2}, {1, 4}, {1, 8}};
    const std::vector<double> b{3.5, 4.0, 5.0, 7.0};
    EXPECT_THAT(nonnegative_fit(rows, b), ElementsAre(DoubleNear(3.0, 1e-6), DoubleNear(0.5, 1e-6)));
}

TEST(NonnegativeFit, AColumnThatWouldBeNegativeIsLeftOut) {
    // The line through these falls: slope -1. The best without it is the mean, 2.
    const std::vector<std::vector<double>> rows{{1, 0}, {1, 1}, {1, 2}};
    const std::vector<double> b{3, 2, 1};
    EXPECT_THAT(nonnegative_fit(rows, b), ElementsAre(DoubleNear(2.0, 1e-9), 0.0));
}

TEST(NonnegativeFit, ColumnsOfAnyUnitComeOutAlike) {
    const std::vector<std::vector<double>> rows{{1, 1e9}, {1, 2e9}, {1, 5e9}};
    const std::vector<double> b{2e-3 + 1, 4e-3 + 1, 10e-3 + 1};  // 1 + 2e-12 * second
    const auto x = nonnegative_fit(rows, b);
    EXPECT_NEAR(x[0], 1.0, 1e-9);
    EXPECT_NEAR(x[1], 2e-12, 1e-17);
}

TEST(NonnegativeFit, ZeroColumnsAndNoRows) {
    const std::vector<std::vector<double>> rows{{0, 2}, {0, 2}};
    EXPECT_THAT(nonnegative_fit(rows, std::vector<double>{4, 4}), ElementsAre(0.0, DoubleNear(2.0, 1e-12)));
    EXPECT_TRUE(nonnegative_fit({}, {}).empty());
}

// At the minimum the gradient A^T (A x - b) is zero where x > 0 and not negative where x = 0 (Karush, Kuhn, Tucker).
TEST(NonnegativeFit, IsAMinimum) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<std::vector<double>> rows(12, std::vector<double>(5));
        std::vector<double> b(12);
        for (auto& row : rows) {
            for (double& v : row) v = uniform(random);
        }
        for (double& v : b) v = uniform(random);
        const auto x = nonnegative_fit(rows, b);
        for (size_t j = 0; j < x.size(); ++j) {
            double gradient = 0.0;
            for (size_t r = 0; r < rows.size(); ++r) {
                double residual = -b[r];
                for (size_t k = 0; k < x.size(); ++k) residual += rows[r][k] * x[k];
                gradient += rows[r][j] * residual;
            }
            EXPECT_GE(x[j], 0.0);
            EXPECT_GE(gradient, -1e-8);
            if (x[j] > 0.0) {
                EXPECT_NEAR(gradient, 0.0, 1e-8);
            }
        }
    }
}

}  // namespace
}  // namespace lightsweep
