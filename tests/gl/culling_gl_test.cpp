// What needs an uploaded scene: its bounds, frames built from it, and instances left out because others hide them,
// wherever the camera was before.
#include "renderer/base/random.h"
#include "renderer/frame/occlusion.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/state.h"
#include "renderer/scene/shapes.h"
#include "shaders/shared/slots.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace lightsweep {
namespace {

constexpr float kNothing = 1e30F;

std::set<uint32_t> as_set(const DrawList& list) { return {list.instances.begin(), list.instances.end()}; }

glm::dvec3 random_point(double half_extent, Random& random) {
    const auto coordinate = [&] { return random.uniform(-half_extent, half_extent); };
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
}

// --- Bounds

TEST(GpuScene, BoundsHoldEveryVertexInTheOrderOfTheBatches) {
    for (const char* key : {"atrium", "cornell"}) {
        const Scene scene = load_scene(key);
        const GpuScene gpu_scene(scene, scene_needs(scene));
        for (size_t i = 0; i < scene.instances.size(); ++i) {
            const Instance& instance = scene.instances[i];
            const Mesh& mesh = scene.meshes[instance.mesh];
            const InstanceBounds& sphere = gpu_scene.instance_bounds()[i];
            double farthest = 0.0;
            for (uint32_t k = 0; k < mesh.index_count; ++k) {
                const glm::dvec4 vertex(scene.vertices[scene.indices[mesh.first_index + k]].position, 1.0);
                farthest = std::max(farthest, glm::distance(glm::dvec3(instance.transform * vertex), sphere.center));
            }
            EXPECT_LE(farthest, sphere.radius) << key << ", instance " << i;
        }
        size_t next = 0;
        for (const Batch& batch : gpu_scene.batches()) {
            for (const uint32_t i : batch.instances) {
                const InstanceBounds& sphere = gpu_scene.instance_bounds()[i];
                const SphereArrays& spheres = gpu_scene.batch_spheres();
                EXPECT_EQ(glm::dvec3(spheres.x[next], spheres.y[next], spheres.z[next]), sphere.center);
                EXPECT_EQ(spheres.radius[next], static_cast<float>(sphere.radius));
                ++next;
            }
        }
        EXPECT_EQ(next, gpu_scene.batch_spheres().size());
    }
}

// --- Balls that hide one another. Pictures of them are made here, ray by ray, apart from what is tested.

constexpr int kWidth = 128, kHeight = 80, kTilePx = OcclusionCuller::kTilePx;
constexpr double kRadii[] = {0.15, 1.5};  // by mesh
constexpr double kHalfExtent = 4.0;

Scene balls(int count, uint64_t seed) {
    Scene scene;
    scene.key = "balls";
    scene.materials.emplace_back();
    for (const double radius : kRadii) {
        const SphereShape ball{.radius = radius, .segments = 8 + static_cast<int>(8.0 * radius)};
        scene.meshes.push_back(append_geometry(scene, make_shape(ball), "ball", scene.key));
    }
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        scene.instances.push_back({.mesh = i % 6 == 0 ? 1U : 0U,
                                   .transform = glm::translate(glm::dmat4(1.0), random_point(kHalfExtent, random))});
    }
    return scene;
}

struct Picture {
    std::vector<float> depths = std::vector<float>(kWidth * kHeight, kNothing);
    std::set<uint32_t> seen;  ///< instances
};

// Of the outsides of balls alone.
Picture draw_balls(const Scene& scene, const FrameSetup& setup, const std::vector<uint32_t>& instances) {
    const CameraBasis basis = camera_basis(setup.camera);
    const double tan_y = std::tan(glm::radians(setup.camera.fov_y_deg) / 2.0), tan_x = tan_y * kWidth / kHeight;
    Picture picture;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 ray = basis.forward + ((x + 0.5) / kWidth * 2.0 - 1.0) * tan_x * basis.right +
                                   ((y + 0.5) / kHeight * 2.0 - 1.0) * tan_y * basis.up;
            const double length = glm::length(ray);
            double nearest = setup.camera.far_distance;
            int64_t front = -1;
            for (const uint32_t i : instances) {
                const double radius = kRadii[scene.instances[i].mesh];
                const glm::dvec3 center = glm::dvec3(scene.instances[i].transform[3]) - setup.camera.eye;
                const double along = glm::dot(center, ray) / length;
                const double half_chord_squared = radius * radius - (glm::dot(center, center) - along * along);
                if (half_chord_squared < 0.0) continue;
                const double z = (along - std::sqrt(half_chord_squared)) / length;
                if (z < setup.camera.near_distance || z >= nearest) continue;
                nearest = z;
                front = i;
            }
            if (front < 0) continue;
            picture.depths[static_cast<size_t>(y * kWidth + x)] = static_cast<float>(nearest);
            picture.seen.insert(static_cast<uint32_t>(front));
        }
    }
    return picture;
}

gl::Texture tile_depths(const Picture& picture) {
    constexpr int kTilesX = kWidth / kTilePx, kTilesY = kHeight / kTilePx;
    std::vector<float> texels;
    for (int ty = 0; ty < kTilesY; ++ty) {
        for (int tx = 0; tx < kTilesX; ++tx) {
            float low = kNothing, high = 0.0F;
            for (int y = ty * kTilePx; y < (ty + 1) * kTilePx; ++y) {
                for (int x = tx * kTilePx; x < (tx + 1) * kTilePx; ++x) {
                    const float depth = picture.depths[static_cast<size_t>(y * kWidth + x)];
                    low = std::min(low, depth);
                    high = std::max(high, depth);
                }
            }
            texels.insert(texels.end(), {low, high, 0.0F, 0.0F});
        }
    }
    gl::Texture texture({.width = kTilesX, .height = kTilesY, .format = gl::Format::RG32F, .label = "tile depths"});
    texture.upload_floats(texels);
    return texture;
}

// What the two phases of one frame draw.
struct Phases {
    std::set<uint32_t> seen_before, newly_seen, visible;
    uint64_t hidden = 0, hidden_triangles = 0;
};

class Balls : public testing::Test {
  protected:
    Phases draw(const Camera& camera) {
        frame_.setup = {};
        build_frame(gpu_scene_, {}, {.camera = camera, .width = kWidth, .height = kHeight}, frame_);
        culler_.begin(gpu_scene_, frame_);
        const DrawList& first = culler_.draws(Instances::seen_before);
        const gl::Texture depths = tile_depths(draw_balls(scene_, frame_.setup, first.instances));
        culler_.find_hidden(depths);
        return {as_set(first), as_set(culler_.draws(Instances::newly_seen)), as_set(culler_.draws(Instances::visible)),
                culler_.hidden_instances(), culler_.hidden_triangles()};
    }
    std::set<uint32_t> seen() const { return draw_balls(scene_, frame_.setup, frame_.visible.instances).seen; }

    Scene scene_ = balls(200, 1);
    GpuScene gpu_scene_{scene_, scene_needs(scene_)};
    Frame frame_;
    OcclusionCuller culler_;
};

// Among the balls, and in them; most steps are small, some lead anywhere.
std::vector<Camera> wandering_camera(int count) {
    Random random(5);
    std::vector<Camera> cameras;
    Camera camera;
    for (int i = 0; i < count; ++i) {
        if (i % 6 == 0) {
            camera.eye = random_point(i % 12 == 0 ? kHalfExtent : 3.0 * kHalfExtent, random);
            camera.target = random_point(kHalfExtent, random);
        } else {
            camera.eye += random_point(0.4, random);
            camera.target += random_point(0.8, random);
        }
        cameras.push_back(camera);
    }
    return cameras;
}

TEST_F(Balls, NothingThatAPixelShowsIsLeftOutWhereverTheCameraWas) {
    uint64_t hidden = 0, hideable = 0, drawn_late = 0, in_view = 0;
    int number = 0;
    for (const Camera& camera : wandering_camera(240)) {
        const Phases phases = draw(camera);
        const auto shown = seen();
        EXPECT_TRUE(std::ranges::includes(phases.visible, shown)) << "frame " << number;

        std::set<uint32_t> both = phases.seen_before;
        both.insert(phases.newly_seen.begin(), phases.newly_seen.end());
        EXPECT_EQ(both, phases.visible);
        EXPECT_EQ(phases.seen_before.size() + phases.newly_seen.size(), phases.visible.size()) << "each once";
        EXPECT_TRUE(std::ranges::includes(as_set(frame_.visible), phases.visible));
        EXPECT_EQ(phases.hidden, frame_.visible.instances.size() - phases.visible.size());
        uint64_t triangles = 0;
        for (const uint32_t i : as_set(frame_.visible)) {
            if (!phases.visible.contains(i)) triangles += scene_.meshes[scene_.instances[i].mesh].index_count / 3;
        }
        EXPECT_EQ(phases.hidden_triangles, triangles);
        hidden += phases.hidden;
        hideable += frame_.visible.instances.size() - shown.size();
        drawn_late += phases.newly_seen.size();
        in_view += frame_.visible.instances.size();
        ++number;
    }
    EXPECT_GT(hidden, in_view / 10) << "of " << hideable << " that no pixel shows, of " << in_view;
    EXPECT_GT(drawn_late, 1000U);
}

TEST_F(Balls, FirstFrameDrawsAllAtOnceAndAStillCameraNothingLate) {
    const Camera camera{.eye = {0.0, 0.0, 12.0}, .target = glm::dvec3(0.0)};
    const Phases first = draw(camera);
    EXPECT_EQ(first.seen_before, as_set(frame_.visible));
    EXPECT_EQ(first.newly_seen.size(), 0U);
    EXPECT_EQ(first.hidden, 0U);
    const Phases second = draw(camera);
    EXPECT_GT(second.hidden, 20U);
    EXPECT_EQ(second.newly_seen.size(), 0U);
    const Phases third = draw(camera);
    EXPECT_EQ(third.visible, second.visible);
    EXPECT_EQ(third.newly_seen.size(), 0U);
}

TEST_F(Balls, WhatWasOutOfViewIsDrawnLate) {
    const Camera camera{.eye = {0.0, 0.0, 12.0}, .target = glm::dvec3(0.0)};
    const Camera away{.eye = camera.eye, .target = {0.0, 0.0, 24.0}};
    draw(camera);
    EXPECT_EQ(draw(away).visible.size(), 0U);
    const Phases back = draw(camera);
    EXPECT_EQ(back.seen_before.size(), 0U);
    EXPECT_EQ(back.newly_seen, as_set(frame_.visible)) << "nothing is there yet to hide them";
}

// A ball alone hides nothing.
TEST_F(Balls, RestsLongerAndLongerWhereNothingIsHidden) {
    const Scene one = balls(1, 1);
    const GpuScene gpu_scene(one, scene_needs(one));
    const FrameSetup setup{
        .camera = {.eye = {0.0, 0.0, 12.0}, .target = glm::dvec3(0.0)}, .width = kWidth, .height = kHeight};
    std::vector<int> looked;
    for (int frame = 0; frame < 80; ++frame) {
        build_frame(gpu_scene, {}, setup, frame_);
        culler_.begin(gpu_scene, frame_);
        EXPECT_EQ(as_set(culler_.draws(Instances::seen_before)), as_set(frame_.visible));
        if (culler_.rests()) {
            EXPECT_EQ(as_set(culler_.draws(Instances::visible)), as_set(frame_.visible));
            continue;
        }
        looked.push_back(frame);
        culler_.find_hidden(tile_depths(draw_balls(one, setup, frame_.visible.instances)));
    }
    EXPECT_EQ(looked, (std::vector<int>{0, 2, 5, 10, 19, 36, 53, 70}));
}

TEST_F(Balls, NeverRestsWhereSomethingIsHidden) {
    const Camera camera{.eye = {0.0, 0.0, 12.0}, .target = glm::dvec3(0.0)};
    for (int frame = 0; frame < 4; ++frame) {
        draw(camera);
        EXPECT_FALSE(culler_.rests()) << frame;
    }
}

TEST_F(Balls, AnotherSceneBeginsAnew) {
    const Camera camera{.eye = {0.0, 0.0, 12.0}, .target = glm::dvec3(0.0)};
    draw(camera);
    ASSERT_GT(draw(camera).hidden, 0U);
    const Scene other = balls(150, 2);
    const GpuScene other_gpu_scene(other, scene_needs(other));
    Frame frame;
    build_frame(other_gpu_scene, {}, {.camera = camera, .width = kWidth, .height = kHeight}, frame);
    culler_.begin(other_gpu_scene, frame);
    EXPECT_EQ(culler_.draws(Instances::seen_before).instances, frame.visible.instances);
}

// Each phase keeps the order of the frame: batches, and instances in them, front to back.
TEST_F(Balls, PhasesKeepTheOrderOfTheFrame) {
    for (const Camera& camera : wandering_camera(30)) {
        draw(camera);
        for (const auto which : {Instances::seen_before, Instances::newly_seen, Instances::visible}) {
            const DrawList& list = culler_.draws(which);
            const auto left = as_set(list);
            size_t next = 0;
            for (const DrawCall& draw : frame_.visible.draws) {
                std::vector<uint32_t> expected;
                for (uint32_t i = 0; i < draw.instance_count; ++i) {
                    const uint32_t instance = frame_.visible.instances[draw.first_visible + i];
                    if (left.contains(instance)) expected.push_back(instance);
                }
                if (expected.empty()) continue;
                ASSERT_LT(next, list.draws.size());
                const DrawCall& kept = list.draws[next++];
                EXPECT_EQ(kept.batch, draw.batch);
                const auto first = list.instances.begin() + kept.first_visible;
                EXPECT_EQ(std::vector<uint32_t>(first, first + kept.instance_count), expected);
            }
            EXPECT_EQ(next, list.draws.size());
        }
    }
}

// --- The shader that says how far the surfaces of a tile are

TEST(TileDepth, WithBackgroundATileWithAHoleIsEndless) {
    constexpr int kPictureWidth = 37, kPictureHeight = 21, kTile = 8, kTilesX = 5, kTilesY = 3;
    Random random(3);
    Frame frame;
    frame.setup = {.camera = {}, .width = kPictureWidth, .height = kPictureHeight};
    set_camera_constants(frame.setup, frame.data);
    frame.data.directional_count = frame.data.light_count = 0;
    Scene nothing;
    const GpuScene gpu_scene(nothing, SceneNeeds{});
    FrameBuffers buffers;
    buffers.upload(frame);
    buffers.bind(gpu_scene);

    std::vector<float> distances(kPictureWidth * kPictureHeight), texels;
    for (int y = 0; y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x) {
            const int tile = y / kTile * kTilesX + x / kTile;  // some without a hole, one all hole, others with one
            const bool hole = tile == 7 || (tile % 3 == 0 && x % kTile == tile % kTile && y % kTile == 2);
            const auto z = static_cast<float>(random.uniform(1.0, 50.0));
            distances[static_cast<size_t>(y * kPictureWidth + x)] = hole ? kNothing : z;
            const float from_far = hole ? 0.0F : frame.data.depth_scale / z - frame.data.depth_offset;
            const float depth = frame.data.depth_clear + from_far;
            texels.insert(texels.end(), {depth, 0.0F, 0.0F, 0.0F});
        }
    }
    gl::Texture depth({.width = kPictureWidth, .height = kPictureHeight, .format = gl::Format::R32F, .label = "depth"});
    depth.upload_floats(texels);
    const gl::Texture ranges(
        {.width = kTilesX, .height = kTilesY, .format = gl::Format::RG32F, .label = "tile depths"});
    const gl::Texture* const colors[] = {&ranges};
    const gl::Framebuffer target(colors, nullptr, "tile depths");
    const gl::VertexArray no_attributes({}, {}, "none");
    const gl::Program program({.vertex = "paths/fullscreen.vert.glsl",
                               .fragment = "lists/tile_depth.frag.glsl",
                               .defines = {"TILE_PX 8", "DEPTH_STEP 0.0", "WITH_BACKGROUND"}});
    target.bind();
    no_attributes.bind();
    program.use();
    gl::apply({});
    depth.bind(shared::kTargetUnit);
    gl::draw_triangles(3);

    const std::vector<float> result = ranges.read_floats(2);
    int endless = 0;
    for (int ty = 0; ty < kTilesY; ++ty) {
        for (int tx = 0; tx < kTilesX; ++tx) {
            float low = kNothing, high = 0.0F;
            for (int y = ty * kTile; y < std::min((ty + 1) * kTile, kPictureHeight); ++y) {
                for (int x = tx * kTile; x < std::min((tx + 1) * kTile, kPictureWidth); ++x) {
                    const float z = distances[static_cast<size_t>(y * kPictureWidth + x)];
                    low = std::min(low, z);
                    high = std::max(high, z);
                }
            }
            endless += high == kNothing ? 1 : 0;
            const auto tile = static_cast<size_t>(2 * (ty * kTilesX + tx));
            EXPECT_NEAR(result[tile], low, 1e-3F * low) << tx << ", " << ty;
            EXPECT_NEAR(result[tile + 1], high, 1e-3F * high) << tx << ", " << ty;
        }
    }
    EXPECT_GT(endless, 2);
    EXPECT_LT(endless, kTilesX * kTilesY - 5);
}

}  // namespace
}  // namespace lightsweep
