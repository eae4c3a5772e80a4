// What must hold for the constants that shaders get of a camera: no digit of its place is lost, and depths lead back to
// their distances.
#include "renderer/base/float_split.h"
#include "renderer/base/random.h"
#include "renderer/frame/frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightsweep {
namespace {

shared::FrameData constants(DepthConvention convention, double near_distance, double far_distance) {
    FrameSetup setup{.camera = {}, .width = 4, .height = 4, .convention = convention};
    setup.camera.near_distance = near_distance;
    setup.camera.far_distance = far_distance;
    shared::FrameData data{};
    set_camera_constants(setup, data);
    return data;
}

TEST(ViewDistance, PlanesComeBackAsTheyAre) {
    for (const double far_distance : {1e2, 1e4, 1e7}) {
        const auto standard = constants(DepthConvention::standard, 1e-3, far_distance);
        const auto reversed = constants(DepthConvention::reversed, 1e-3, far_distance);
        // Also where f / (f - n) is no float but 1.
        EXPECT_NEAR(static_cast<double>(view_distance(standard, 1.0F)), far_distance, 1e-6 * far_distance);
        EXPECT_NEAR(static_cast<double>(view_distance(reversed, 0.0F)), far_distance, 1e-6 * far_distance);
        EXPECT_NEAR(static_cast<double>(view_distance(standard, 0.0F)), 1e-3, 1e-9);
        EXPECT_NEAR(static_cast<double>(view_distance(reversed, 1.0F)), 1e-3, 1e-9);
    }
}

TEST(ViewDistance, IsRightToASmallShareOfADepthStep) {
    // The last float below 1 is one step of 2^-24 from it: its distance is B / (2^-24 + n / (f - n)).
    const auto standard = constants(DepthConvention::standard, 0.1, 1000.0);
    const double exact = (0.1 * 1000.0 / 999.9) / (0x1p-24 + 0.1 / 999.9);
    EXPECT_NEAR(static_cast<double>(view_distance(standard, std::nextafter(1.0F, 0.0F))), exact, 1e-6 * exact);
}

TEST(FloatSplit, RoundsAsAConversionDoes) {
    Random random(7);
    for (int i = 0; i < 10000; ++i) {
        const double value = random.uniform(-1.0, 1.0) * std::exp2(random.uniform(-100.0, 100.0));
        const volatile auto converted = static_cast<float>(value);  // volatile: no compiler may skip it
        ASSERT_EQ(rounded_to_float(value), static_cast<double>(converted)) << value;
    }
    EXPECT_EQ(rounded_to_float(0.0), 0.0);
    EXPECT_EQ(rounded_to_float(1.0 + 0x1p-24), 1.0) << "a tie goes to the even one";
    EXPECT_EQ(rounded_to_float(1.0 + 0x1p-23 + 0x1p-24), 1.0 + 0x1p-22);
    EXPECT_EQ(rounded_to_float(2.0 - 0x1p-30), 2.0) << "the carry reaches the exponent";
}

TEST(CameraConstants, HighAndLowPartsHoldEveryPlace) {
    Random random(16);
    for (int i = 0; i < 1000; ++i) {
        FrameSetup setup;
        for (int k = 0; k < 3; ++k) setup.camera.eye[k] = random.uniform(-1e7, 1e7);
        setup.camera.target = setup.camera.eye + glm::dvec3(0.3, -0.2, 1.0);
        shared::FrameData data{};
        set_camera_constants(setup, data);
        for (int k = 0; k < 3; ++k) {
            const double sum = static_cast<double>(data.camera_high[k]) + static_cast<double>(data.camera_low[k]);
            ASSERT_NEAR(sum, setup.camera.eye[k], 0x1p-48 * 1e7) << "coordinate " << k;
        }
    }
}

}  // namespace
}  // namespace lightsweep
