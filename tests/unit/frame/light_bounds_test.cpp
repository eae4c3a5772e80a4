// Bounds of lights: they hold what the lights reach, grown as promised, and rectangles on the screen fit them.
#include "tests/unit/frame/lights.h"

#include <gtest/gtest.h>

#include <limits>

namespace lightsweep {
namespace {

using shared::LightBounds;

double degrees(double angle) { return angle * 3.141592653589793 / 180.0; }

TEST(SphereAroundCone, IsTheSmallest) {
    const glm::dvec3 apex(1.0, 2.0, 3.0), axis(0.0, 0.0, 1.0);
    // Narrow: around the triangle of apex and rim, whose circumscribed circle has the radius range / (2 cos).
    const Sphere narrow = sphere_around_cone(apex, axis, 2.0, std::cos(degrees(30.0)));
    EXPECT_NEAR(narrow.radius, 2.0 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(narrow.center.z, 3.0 + 2.0 / std::sqrt(3.0), 1e-12);
    // Wide: around the rim.
    const Sphere wide = sphere_around_cone(apex, axis, 2.0, std::cos(degrees(60.0)));
    EXPECT_NEAR(wide.radius, std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(wide.center.z, 4.0, 1e-12);
    // Half of space and more: around all of the range.
    for (const double cosine : {0.0, -0.5}) {
        const Sphere full = sphere_around_cone(apex, axis, 2.0, cosine);
        EXPECT_EQ(full.radius, 2.0);
        EXPECT_EQ(full.center, apex);
    }
}

TEST(LightBounds, StandInViewSpaceInTheOrderOfTheLights) {
    FrameSetup setup = plain_setup();
    setup.camera.eye = {10.0, 0.0, 0.0};
    setup.camera.target = {10.0, 0.0, -1.0};  // looks along -z; right is +x, up is +y
    const Light sun{.kind = LightKind::directional};
    const Light point{.position = {11.0, 2.0, -5.0}, .radius = 3.0};
    const Light spot{.kind = LightKind::spot,
                     .position = {9.0, 1.0, -4.0},
                     .direction = {0.0, 0.0, -1.0},
                     .radius = 2.0,
                     .outer_deg = 60.0};
    std::vector<LightBounds> bounds(7);
    light_bounds(frame_of(setup, {point, sun, spot}), 0.0, bounds);
    ASSERT_EQ(bounds.size(), 2U) << "the sun has none";
    EXPECT_LT(glm::distance(bounds[0].center, glm::vec3(1.0F, 2.0F, 5.0F)), 1e-5F);
    EXPECT_NEAR(bounds[0].radius, 3.0 + (std::sqrt(30.0) + 3.0) / 4096.0, 1e-5);
    EXPECT_EQ(bounds[0].cos_half_angle, -1.0F);
    EXPECT_LT(glm::distance(bounds[1].center, glm::vec3(-1.0F, 1.0F, 5.0F)), 1e-5F) << "1 ahead of the light";
    EXPECT_NEAR(bounds[1].radius, std::sqrt(3.0), 0.01);
    EXPECT_LT(glm::distance(bounds[1].axis, glm::vec3(0.0F, 0.0F, 1.0F)), 1e-6F);
    EXPECT_NEAR(bounds[1].cos_half_angle, 0.5, 1e-3);
}

// Whether the sphere and the cone of a light hold a point in view space.
bool holds(const LightBounds& light, const glm::dvec3& point) {
    if (glm::distance(point, glm::dvec3(light.center)) > light.radius) return false;
    if (light.cos_half_angle <= 0.0F) return true;
    const glm::dvec3 from_apex = point - glm::dvec3(light.apex);
    const double distance = glm::length(from_apex);
    return distance <= light.range && glm::dot(from_apex, glm::dvec3(light.axis)) >= light.cos_half_angle * distance;
}

TEST(LightBounds, HoldWhereASurfaceIsAndWhereItsCellSaysItIs) {
    int reached = 0;
    for (uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const double error = seed % 4 == 0 ? 0.0 : log_uniform(random, 0x1p-12, 0x1p-4);
        const TestView view(random_setup(random));
        const Frame frame = frame_of(view.setup, random_lights(view, 20, random));
        std::vector<LightBounds> bounds;
        light_bounds(frame, error, bounds);
        for (int k = 0; k < 300; ++k) {
            const SurfacePoint point = random_point(view, frame, error, random);
            for (size_t i = 0; i < frame.lights.size(); ++i) {
                if (!reaches(frame.lights[i], view.to_world(point.read))) continue;
                ++reached;
                EXPECT_TRUE(holds(bounds[i], point.read)) << "seed " << seed;
                EXPECT_TRUE(holds(bounds[i], point.place)) << "seed " << seed;
                const glm::dvec3 in_cell = point.read.z * view.ray(point.x, point.y);
                EXPECT_TRUE(holds(bounds[i], in_cell)) << "seed " << seed;
            }
        }
    }
    EXPECT_GT(reached, 50'000);
}

TEST(LightBounds, NarrowConesStayNarrow) {
    const TestView view(plain_setup());
    for (const double outer_deg : {2.0, 10.0, 30.0, 60.0}) {
        Light light{.kind = LightKind::spot, .direction = view.forward, .radius = 10.0, .inner_deg = 1.0};
        light.position = view.setup.camera.eye + view.to_world({0.0, 0.0, 5.0});
        light.outer_deg = outer_deg;
        std::vector<LightBounds> bounds;
        light_bounds(frame_of(view.setup, {light}), 0.0, bounds);
        // The side of the bounds at the end of the range, against the cone's own: 2^-12 of 15 units, and what rounding
        // of the cosine and a widened angle add.
        const double grown = std::sqrt(1.0 - bounds[0].cos_half_angle * bounds[0].cos_half_angle) * bounds[0].range;
        EXPECT_LT(grown, 10.0 * std::sin(degrees(outer_deg)) + 0.12) << outer_deg;
        EXPECT_LT(bounds[0].range, 10.2) << outer_deg;
    }
}

// Whether the ray meets the sphere in front of the eye.
bool meets(const glm::dvec3& ray, const LightBounds& light, double radius_factor) {
    const glm::dvec3 center(light.center), direction = glm::normalize(ray);
    const double radius = light.radius * radius_factor, along = glm::dot(center, direction);
    const double across_squared = glm::dot(center, center) - along * along;
    if (across_squared > radius * radius) return false;
    return along + std::sqrt(radius * radius - across_squared) > 0.0;
}

TEST(ScreenRect, HoldsEveryPixelThatMeetsTheSphereAndFits) {
    int partial = 0;
    for (uint64_t seed = 0; seed < 600; ++seed) {
        Random random(seed);
        FrameSetup setup = random_setup(random);
        if (seed % 2 == 0) setup = plain_setup(211, 133);
        const TestView view(setup);
        const double far = view.setup.camera.far_distance;
        const double z = log_uniform(random, view.setup.camera.near_distance, std::min(far, 1e3));
        LightBounds light{};
        light.center = glm::vec3(random.uniform(-1.5, 1.5) * view.tan_x * z, random.uniform(-1.5, 1.5) * view.tan_y * z,
                                 random.index(4) == 0 ? -z : z);
        light.radius = glm::length(light.center) * static_cast<float>(log_uniform(random, 0.02, 1.5));
        const PixelRect rect = screen_rect(light, view.setup);
        PixelRect tight{view.setup.width, view.setup.height, 0, 0};
        for (int y = 0; y < view.setup.height; ++y) {
            for (int x = 0; x < view.setup.width; ++x) {
                if (!meets(view.ray(x, y), light, 1.0 - 1e-9)) continue;
                tight = {std::min(tight.x0, x), std::min(tight.y0, y), std::max(tight.x1, x + 1),
                         std::max(tight.y1, y + 1)};
                ASSERT_TRUE(x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1)
                    << "seed " << seed << ", pixel " << x << ", " << y;
            }
        }
        // The ellipse that a sphere is seen as touches its rectangle, unless the picture's edge cuts the place off.
        const bool inside = rect.x0 > 0 && rect.y0 > 0 && rect.x1 < view.setup.width && rect.y1 < view.setup.height;
        if (!inside || rect.x1 - rect.x0 < 8 || rect.y1 - rect.y0 < 8) continue;
        ++partial;
        EXPECT_LE(tight.x0 - rect.x0, 2) << "seed " << seed;
        EXPECT_LE(tight.y0 - rect.y0, 2) << "seed " << seed;
        EXPECT_LE(rect.x1 - tight.x1, 2) << "seed " << seed;
        EXPECT_LE(rect.y1 - tight.y1, 2) << "seed " << seed;
    }
    EXPECT_GT(partial, 20);
}

LightBounds sphere(const glm::vec3& center, float radius) {
    LightBounds light{};
    light.center = center;
    light.radius = radius;
    return light;
}

TEST(ScreenRect, OfASphereAroundTheEyeIsThePicture) {
    const PixelRect all{0, 0, 320, 180};
    EXPECT_EQ(screen_rect(sphere({0.0F, 0.0F, 0.0F}, 1.0F), plain_setup()), all);
    EXPECT_EQ(screen_rect(sphere({0.3F, -0.2F, -0.5F}, 1.0F), plain_setup()), all);
}

TEST(ScreenRect, IsEmptyBehindAndBeside) {
    EXPECT_EQ(screen_rect(sphere({0.0F, 0.0F, -2.0F}, 1.0F), plain_setup()), PixelRect{});
    EXPECT_EQ(screen_rect(sphere({90.0F, 0.0F, 10.0F}, 1.0F), plain_setup()), PixelRect{});
    EXPECT_EQ(screen_rect(sphere({0.0F, -90.0F, 10.0F}, 1.0F), plain_setup()), PixelRect{});
}

TEST(ScreenRect, OfWhatIsNoNumberIsThePicture) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    const PixelRect all{0, 0, 320, 180};
    EXPECT_EQ(screen_rect(sphere({0.0F, 0.0F, 5.0F}, kNan), plain_setup()), all);
    EXPECT_EQ(screen_rect(sphere({kNan, kInf, 5.0F}, 1.0F), plain_setup()), all);
    EXPECT_EQ(screen_rect(sphere({-kInf, kNan, 5.0F}, 1.0F), plain_setup()), all);
}

// At 90 degrees, 200x200 px: the slope s is at the pixel coordinate 100 + 100 s. A sphere of radius 3 around (0, 0, 5)
// has tangents of the slope 3/4; around (-4, 0, 0), which straddles the plane of the eye, with radius 2.4 (a tangent of
// length 3.2), it is seen up to the slope -3.2/2.4, and so not at all.
TEST(ScreenRect, KnownCases) {
    FrameSetup setup = plain_setup(200, 200);
    setup.camera.fov_y_deg = 90.0;
    EXPECT_EQ(screen_rect(sphere({0.0F, 0.0F, 5.0F}, 3.0F), setup), (PixelRect{25, 25, 175, 175}));
    EXPECT_EQ(screen_rect(sphere({-4.0F, 0.0F, 0.0F}, 2.4F), setup), PixelRect{});
    // With radius 3.2 the tangent has the length 2.4: the slope is -3/4; and all of the height.
    EXPECT_EQ(screen_rect(sphere({-4.0F, 0.0F, 0.0F}, 3.2F), setup), (PixelRect{0, 0, 25, 200}));
}

}  // namespace
}  // namespace lightsweep
