// Powers by arithmetic alone, against the library's in double precision.
#include "bench/metrics/vector_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightsweep {
namespace {

TEST(VectorMath, IsWithinAFewUnitsInTheLastPlace) {
    for (double exact = 1e-36; exact < 1e36; exact *= 1.0137) {
        const auto x = static_cast<float>(exact);
        const double log = std::log2(double{x});
        ASSERT_NEAR(vector_log2(x), log, 1.2e-7 * std::max(1.0, std::abs(log))) << x;
        for (const float p : {1.0F / 3.0F, 0.7F, 1.0F}) {
            const double power = std::pow(double{x}, double{p});
            ASSERT_NEAR(vector_pow(x, p) / power, 1, 1.1e-7 * (2 + p * std::abs(log))) << x << " " << p;
        }
    }
    for (double x = -126; x <= 127; x += 0.0137) {
        const auto exponent = static_cast<float>(x);
        ASSERT_NEAR(vector_exp2(exponent) / std::exp2(double{exponent}), 1, 3e-7) << x;
    }
}

TEST(VectorMath, IsExactWhereMetricsRelyOnIt) {
    for (const float p : {0.0F, 0.25F, 0.7F, 2.4F}) EXPECT_EQ(vector_pow(1, p), 1) << p;
    for (const float p : {0.0F, 0.25F, 0.7F, 1.0F}) EXPECT_EQ(vector_pow(0, p), 0) << p;
    EXPECT_EQ(choose(true, 1, 2), 1);
    EXPECT_EQ(choose(false, 1, 2), 2);
}

}  // namespace
}  // namespace lightsweep
