// Which lights a frame keeps: all that reach the view, by their true bounds.
#include "tests/unit/frame/lights.h"

#include <gtest/gtest.h>

#include <limits>

namespace lightsweep {
namespace {

TEST(CollectLights, DirectionalOnesComeFirstAndUselessOnesNever) {
    const FrameSetup setup = plain_setup();
    const glm::dvec3 ahead = setup.camera.eye + 5.0 * glm::normalize(setup.camera.target - setup.camera.eye);
    const Frame frame = frame_of(setup, {{.position = ahead, .color = {1.0, 0.0, 0.0}, .radius = 2.0},
                                         {.kind = LightKind::directional, .color = {0.0, 2.0, 0.0}},
                                         {.position = ahead, .color = glm::dvec3(0.0), .radius = 2.0},
                                         {.position = ahead, .radius = 0.0},
                                         {.kind = LightKind::directional, .color = glm::dvec3(0.0)},
                                         {.position = ahead, .color = {0.0, 0.0, 3.0}, .radius = 2.0}});
    ASSERT_EQ(frame.lights.size(), 3U);
    EXPECT_EQ(frame.lights[0].color.g, 2.0F);
    EXPECT_EQ(frame.lights[1].color.r, 1.0F);
    EXPECT_EQ(frame.lights[2].color.b, 3.0F);
    EXPECT_EQ(frame.data.directional_count, 1U);
    EXPECT_EQ(frame.data.light_count, 3U);
    EXPECT_EQ(frame.work.lights_drawn, 3U);
    EXPECT_EQ(frame.work.lights_culled, 3U);
}

// What reaches nothing, and where nobody knows: no list could hold it, with culling or without.
TEST(CollectLights, NoLightIsKeptWhosePlaceIsNoNumber) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
    const TestView view(plain_setup());
    const Light light{.position = view.setup.camera.eye + 5.0 * view.forward, .radius = 2.0};
    std::vector<Light> lights;
    for (const double bad : {kNan, kInf, -kInf}) {
        lights.push_back(light);
        lights.back().position.y = bad;
        lights.push_back(light);
        lights.back().kind = LightKind::spot;
        lights.back().direction.z = bad;
        lights.push_back(lights.back());
        lights.back().kind = LightKind::directional;
    }
    lights.push_back(light);
    lights.back().radius = kNan;
    FrameSetup setup = view.setup;
    for (const SkipSet skips : {SkipSet::all(), SkipSet::none()}) {
        setup.skips = skips;
        const Frame frame = frame_of(setup, lights);
        EXPECT_TRUE(frame.lights.empty());
        EXPECT_EQ(frame.work.lights_culled, lights.size());
    }
    Light everywhere = light;
    everywhere.radius = kInf;
    EXPECT_EQ(frame_of(setup, {everywhere}).lights.size(), 1U) << "an infinite radius is one";
    Light no_color = light;
    no_color.color.g = kNan;
    EXPECT_EQ(frame_of(setup, {no_color}).lights.size(), 1U) << "it shines on its own pixels";
}

TEST(CollectLights, NoIntensityOverflowsWhenItIsDividedByTheLeastSquare) {
    const TestView view(plain_setup());
    Light light{.position = view.setup.camera.eye + 5.0 * view.forward, .color = {1e300, -1e300, 7.0}, .radius = 2.0};
    const auto color = [&] { return frame_of(view.setup, {light}).lights.at(0).color; };
    EXPECT_TRUE(std::isfinite(color().r / 1e-4F) && color().r > 1e34F);
    EXPECT_TRUE(std::isfinite(color().g / 1e-4F) && color().g < -1e34F);
    EXPECT_EQ(color().b, 7.0F);
    light.color.r = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(color().r)) << "not made a colour that nobody asked for";
}

// A light behind the eye whose range includes the eye.
TEST(CollectLights, SpotIsKeptForItsConeAndNotForItsSphere) {
    const TestView view(plain_setup());
    Light light{.position = view.setup.camera.eye - 1.0 * view.forward, .radius = 3.0};
    const auto kept = [&] { return frame_of(view.setup, {light}).lights.size(); };
    EXPECT_EQ(kept(), 1U) << "as a point it lights the view";
    light.kind = LightKind::spot;
    light.direction = view.forward;
    EXPECT_EQ(kept(), 1U) << "as a spot too, when it shines there";
    light.direction = -view.forward;
    EXPECT_EQ(kept(), 0U) << "but not when it shines away";
    light.outer_deg = 120.0;
    EXPECT_EQ(kept(), 1U) << "unless it shines all around";
}

TEST(CollectLights, EveryLightThatReachesTheViewIsKept) {
    int culled = 0;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const TestView view(random_setup(random));
        const auto lights = random_lights(view, 20, random);
        for (const Light& light : lights) {
            if (!frame_of(view.setup, {light}).lights.empty()) continue;
            ++culled;
            Frame aim;  // for random_point
            shared::LightData data{.position = glm::vec3(light.position - view.setup.camera.eye),
                                   .radius = static_cast<float>(light.radius),
                                   .color = glm::vec3(1.0F),
                                   .spot_scale = 0.0F,
                                   .direction = glm::vec3(light.direction),
                                   .spot_offset = 1.0F};
            if (light.kind == LightKind::spot) {
                data.spot_scale = 1.0F;
                data.spot_offset = -static_cast<float>(std::cos(glm::radians(light.outer_deg)));
            }
            aim.lights = {data};
            for (int k = 0; k < 50; ++k) {
                const SurfacePoint point = random_point(view, aim, 0.0, random);
                EXPECT_FALSE(reaches(data, (1.0 - 1e-6) * view.to_world(point.place))) << "seed " << seed;
            }
        }
    }
    EXPECT_GT(culled, 500);
}

// Without the switch every light is kept, the useless ones too, and those that are kept with it are the same.
TEST(CollectLights, WithoutTheFrustumAllAreKeptTheOthersInTheSameOrder) {
    const auto key = [](const shared::LightData& light) {
        return std::vector<float>{light.position.x,  light.position.y, light.position.z,  light.radius,
                                  light.color.r,     light.spot_scale, light.direction.x, light.direction.y,
                                  light.direction.z, light.spot_offset};
    };
    size_t culled = 0;
    for (uint64_t seed = 0; seed < 100; ++seed) {
        Random random(seed);
        TestView view(random_setup(random));
        auto lights = random_lights(view, 700, random);  // more than are tested at once
        for (size_t i = 0; i < lights.size(); ++i) {
            if (i % 11 == 0) lights[i].color = glm::dvec3(0.0);
            if (i % 13 == 0) lights[i].radius = 0.0;
            if (i % 17 == 0) lights[i].kind = LightKind::directional;
        }
        const Frame with = frame_of(view.setup, lights);
        view.setup.skips = SkipSet::all().without(Skip::light_frustum);
        const Frame without = frame_of(view.setup, lights);
        EXPECT_EQ(without.lights.size(), lights.size());
        EXPECT_EQ(without.work.lights_culled, 0U);
        EXPECT_GE(without.data.directional_count, with.data.directional_count);
        culled += with.work.lights_culled;
        auto next = without.lights.begin();
        for (size_t i = 0; i < with.lights.size(); ++i) {
            while (next != without.lights.end() && key(*next) != key(with.lights[i])) ++next;
            ASSERT_NE(next, without.lights.end()) << "seed " << seed << ": light " << i << " is out of order";
            const auto place = static_cast<size_t>(next - without.lights.begin());
            EXPECT_EQ(place < without.data.directional_count, i < with.data.directional_count);
            ++next;
        }
    }
    EXPECT_GT(culled, 10'000U);
}

// Lights that give nothing, where shaders and bounds divide: local_light of shaders/lib/light.glsl, in single
// precision.
TEST(CollectLights, UselessOnesThatAreKeptAreNumbersAndDark) {
    FrameSetup setup = plain_setup();
    setup.skips = SkipSet::none();
    std::vector<Light> lights;
    for (const auto kind : {LightKind::point, LightKind::spot}) {
        for (const double radius : {0.0, -1.0, 1e-30, 1.0}) {
            const bool black = radius == 1.0;
            for (const double away : {0.0, 3.0}) {
                lights.push_back({.kind = kind,
                                  .position = setup.camera.eye + away * glm::dvec3(1.0, 0.0, 0.0),
                                  .color = glm::dvec3(black ? 0.0 : 5.0),
                                  .radius = radius});
            }
        }
    }
    const Frame frame = frame_of(setup, lights);
    ASSERT_EQ(frame.lights.size(), lights.size());
    for (const auto& light : frame.lights) {
        for (const float distance : {0.0F, 1e-10F, 1e-3F, 1.0F, 1e4F, 1e15F}) {
            const float distance_squared = distance * distance;
            const float ratio = distance_squared / (light.radius * light.radius);
            const float window = std::max(1.0F - ratio * ratio, 0.0F);
            const float irradiance = light.color.r * window * window / std::max(distance_squared, 1e-4F);
            EXPECT_TRUE(std::isfinite(irradiance));
            // At no distance at all there is no direction either, and so no reflected light.
            EXPECT_TRUE(irradiance == 0.0F || distance == 0.0F) << light.radius << " at " << distance;
        }
    }
    std::vector<shared::LightBounds> bounds;
    light_bounds(frame, 0.0, bounds);
    ASSERT_EQ(bounds.size(), lights.size());
    for (const auto& light : bounds) {
        for (const float value :
             {light.center.x, light.radius, light.apex.x, light.range, light.axis.x, light.cos_half_angle}) {
            EXPECT_TRUE(std::isfinite(value));
        }
        EXPECT_GE(light.radius, 0.0F);
        EXPECT_GE(light.range, 0.0F);
    }
}

}  // namespace
}  // namespace lightsweep
