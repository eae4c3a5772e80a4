// Visibility without a device: what is in front, what faces away, what the planes of the camera cut off.
#include "tests/unit/reference/scenes.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace lightsweep {
namespace {

glm::dmat4 at_depth(double z, double scale) {
    return glm::scale(glm::translate(glm::dmat4(1.0), {0, 0, z}), glm::dvec3(scale));
}

std::vector<uint32_t> instances_seen(const Scene& scene, int width, int height, const Camera& camera = kFrontCamera) {
    std::vector<uint32_t> seen;
    for (const auto& pixel : cast_visibility(scene, camera, width, height).triangles) seen.push_back(pixel.instance);
    return seen;
}

TEST(CastVisibility, SeesTheNearerSurface) {
    // Four units away the view is eight wide: the near quad covers the middle half of it, the far one the rest.
    for (const bool near_first : {true, false}) {
        Scene scene;
        add_quad(scene, near_first ? at_depth(0, 2) : at_depth(-1, 20));
        add_quad(scene, near_first ? at_depth(-1, 20) : at_depth(0, 2));
        const uint32_t n = near_first ? 0 : 1, f = 1 - n;
        EXPECT_EQ(instances_seen(scene, 4, 4), (std::vector{f, f, f, f, f, n, n, f, f, n, n, f, f, f, f, f}));
    }
}

TEST(CastVisibility, NamesTheTriangleOfTheMesh) {
    // Triangle 0 of a quad is its lower right half, triangle 1 its upper left one. Row 0 is the top.
    Scene scene;
    add_quad(scene, at_depth(0, 4));
    const auto visible = cast_visibility(scene, kFrontCamera, 4, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            if (x + y == 3) continue;  // on the diagonal
            EXPECT_EQ(visible.triangles[static_cast<size_t>(4 * y + x)].triangle, x + y > 3 ? 0U : 1U) << x << ' ' << y;
        }
    }
}

TEST(CastVisibility, LeavesOutWhatFacesAway) {
    const glm::dmat4 mirrored = glm::scale(glm::dmat4(1.0), {-9, 9, 9});
    const glm::dmat4 turned = glm::rotate(at_depth(0, 9), glm::radians(180.0), {0.0, 1.0, 0.0});
    for (const bool double_sided : {false, true}) {
        const auto sees = [&](const glm::dmat4& transform) {
            Scene scene;
            add_quad(scene, transform, {.name = "sheet", .double_sided = double_sided});
            return instances_seen(scene, 1, 1).front() == 0;
        };
        EXPECT_TRUE(sees(mirrored)) << "turned inside out twice";
        EXPECT_EQ(sees(turned), double_sided);
    }
}

TEST(CastVisibility, EndsAtTheNearAndTheFarPlane) {
    Scene scene;
    add_quad(scene, at_depth(0, 9));
    for (const auto& [near_distance, far_distance, seen] :
         {std::tuple{0.1, 100.0, true}, {3.9, 4.1, true}, {4.1, 100.0, false}, {0.1, 3.9, false}}) {
        Camera camera = kFrontCamera;
        camera.near_distance = near_distance;
        camera.far_distance = far_distance;
        EXPECT_EQ(instances_seen(scene, 1, 1, camera).front() == 0, seen) << near_distance << ' ' << far_distance;
    }
}

TEST(CastVisibility, SeesFloorThatReachesBehindTheEye) {
    // At y = -1, from behind the eye to the far plane: every pixel below the horizon, and no other.
    Scene scene;
    add_quad(scene, glm::rotate(glm::translate(glm::dmat4(1.0), {0, -1, 0}), glm::radians(-90.0), {1.0, 0.0, 0.0}) *
                        glm::scale(glm::dmat4(1.0), glm::dvec3(1000.0)));
    const auto seen = instances_seen(scene, 64, 64);
    EXPECT_TRUE(std::all_of(seen.begin(), seen.begin() + 32 * 64, [](uint32_t i) { return i == kNoSurface; }));
    EXPECT_TRUE(std::all_of(seen.begin() + 33 * 64, seen.end(), [](uint32_t i) { return i == 0; }));
}

}  // namespace
}  // namespace lightsweep
