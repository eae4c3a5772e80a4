// What must hold for the law of depth errors: textbook numbers, and that it says what a depth buffer in double
// precision does.
#include "bench/stress/depth_law.h"

#include "bench/stress/parameter_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace lightsweep {
namespace {

constexpr auto kStandard = DepthConvention::standard, kReversed = DepthConvention::reversed;
constexpr auto kZeroToOne = gl::ClipDepth::zero_to_one;

DepthLaw law_of(gl::Format format, DepthConvention convention, double near_distance = 0.1,
                double far_distance = 1000.0) {
    return {format, convention, kZeroToOne, near_distance, far_distance};
}

TEST(DepthLaw, FloatSpacingIsTheNextFloats) {
    for (const float value : {1.0F, 0.75F, 1e-6F, 3e7F, 0x1p-126F, 1e-40F}) {
        const float next = std::nextafter(value, std::numeric_limits<float>::infinity());
        EXPECT_EQ(float_spacing(static_cast<double>(value)), static_cast<double>(next) - static_cast<double>(value));
    }
    EXPECT_EQ(float_spacing(-1.5), 0x1p-23);
}

TEST(DepthLaw, PlanesHaveTheirDepths) {
    for (const gl::Format format : {gl::Format::D16, gl::Format::D24, gl::Format::D32F}) {
        EXPECT_NEAR(law_of(format, kStandard).depth(0.1), 0.0, 1e-15);
        EXPECT_NEAR(law_of(format, kStandard).depth(1000.0), 1.0, 1e-15);
        EXPECT_NEAR(law_of(format, kReversed).depth(0.1), 1.0, 1e-15);
        EXPECT_NEAR(law_of(format, kReversed).depth(1000.0), 0.0, 1e-15);
    }
}

TEST(DepthLaw, DistanceIsTheInverseOfDepth) {
    for (const auto convention : {kStandard, kReversed}) {
        const DepthLaw law = law_of(gl::Format::D32F, convention);
        for (const double z : {0.1, 0.35, 2.0, 77.0, 1000.0}) EXPECT_NEAR(law.distance(law.depth(z)), z, 1e-9 * z);
        EXPECT_NEAR(law.distance(2.0), convention == kStandard ? 1000.0 : 0.1, 1e-12 * 1000.0);
    }
}

TEST(DepthLaw, SixteenBitsLoseHalfAStepOfTheHyperbola) {
    // dz = z^2 (f - n) / (f n) * 2^-17, by hand at z = 10: 100 * 9.999 * 7.63e-6 = 7.63e-3, over 10.
    // What the arithmetic in 32 bits adds is a fiftieth of it.
    EXPECT_NEAR(law_of(gl::Format::D16, kStandard).distance_error(10.0), 7.63e-4, 0.06 * 7.63e-4);
    EXPECT_NEAR(law_of(gl::Format::D16, kReversed).distance_error(10.0), 7.63e-4, 0.06 * 7.63e-4);
    const double near_by = law_of(gl::Format::D16, kStandard).distance_error(1.0);
    EXPECT_NEAR(near_by, 7.63e-5, 0.06 * 7.63e-5) << "linear in the distance";
}

TEST(DepthLaw, ReversedFloatIsEvenAndStandardFloatIsNot) {
    const DepthLaw reversed = law_of(gl::Format::D32F, kReversed, 0.001, 1e7);
    const DepthLaw standard = law_of(gl::Format::D32F, kStandard, 0.001, 1e7);
    for (const double z : {0.01, 1.0, 100.0, 1e4, 1e6}) {
        EXPECT_LE(reversed.distance_error(z), 9.0 * 0x1p-24) << z;
        EXPECT_GE(reversed.distance_error(z), 0x1p-24) << z;
    }
    EXPECT_GT(standard.distance_error(1.0), 100.0 * reversed.distance_error(1.0));
    EXPECT_GT(standard.distance_error(100.0), 50.0 * standard.distance_error(1.0));
}

TEST(DepthLaw, WithoutClipControlReversedFloatGainsNothing) {
    const DepthLaw halved(gl::Format::D32F, kReversed, gl::ClipDepth::minus_one_to_one, 0.1, 1000.0);
    const double standard = law_of(gl::Format::D32F, kStandard).distance_error(100.0);
    EXPECT_GT(halved.distance_error(100.0), 0.2 * standard);
    EXPECT_GT(halved.distance_error(100.0), 100.0 * law_of(gl::Format::D32F, kReversed).distance_error(100.0));
}

// Where a step of depth is wider than what is left to the far plane, the slope would promise an error without end.
TEST(DepthLaw, NoErrorReachesPastThePlanes) {
    const DepthLaw law = law_of(gl::Format::D16, kStandard, 0.001, 1e7);
    EXPECT_LE(law.distance_error(1e6), (1e7 - 0.001) / 1e6);
    EXPECT_GE(law.distance_error(1e6), 1.0);
}

TEST(ParameterGrid, HoldsItsEndsAndIsFineEnough) {
    for (const auto& [first, last] : {std::pair(1.0, 1e6), std::pair(1e-1, 1e-8)}) {
        const ParameterGrid grid(first, last);
        EXPECT_EQ(grid[0], first);
        EXPECT_NEAR(grid[grid.size() - 1], last, 1e-12 * last);
        EXPECT_EQ(grid.nearest(first), 0U);
        EXPECT_EQ(grid.nearest(last), grid.size() - 1);
        for (double share = 0.0; share < 1.0; share += 0.0137) {
            const double value = first * std::pow(last / first, share);
            EXPECT_NEAR(std::log(grid[grid.nearest(value)] / value), 0.0, 0.0125);
        }
    }
}

}  // namespace
}  // namespace lightsweep
