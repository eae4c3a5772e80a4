// Which lights a frame keeps: all that reach the view, by their true bounds.
#include "tests/unit/frame/lights.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lightsweep
