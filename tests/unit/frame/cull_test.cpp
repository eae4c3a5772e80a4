// Which instances a frame draws, and in which order: all that the view may show, few others, front to back.
#include "renderer/frame/cull.h"
#include "tests/unit/frame/lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace lightsweep {
namespace {

using testing::ElementsAreArray;

// Instances of a few batches, some of them empty, dealt out at random.
struct TestScene {
    explicit TestScene(size_t batch_count = 1) : batches(batch_count) {
        for (size_t b = 0; b < batch_count; ++b) batches[b].index_count = static_cast<uint32_t>(3 * b + 3);
    }

    void add(const InstanceBounds& sphere, size_t batch = 0) {
        batches[batch].instances.push_back(static_cast<uint32_t>(bounds.size()));
        bounds.push_back(sphere);
    }

    Frame frame(const FrameSetup& setup) const {
        SphereArrays spheres;
        for (const Batch& batch : batches) {
            for (const uint32_t i : batch.instances) spheres.add(bounds[i]);
        }
        Frame frame;
        frame.setup = setup;
        cull_instances(batches, spheres, frame);
        return frame;
    }

    std::vector<Batch> batches;
    std::vector<InstanceBounds> bounds;
};

glm::dvec3 to_view(const TestView& view, const glm::dvec3& v) {
    return {glm::dot(v, view.right), glm::dot(v, view.up), glm::dot(v, view.forward)};
}

// How far inside of the view's planes a point in view space is, or, when negative, outside of one.
double depth_inside(const TestView& view, const glm::dvec3& p) {
    const auto side = [&](double across, double tangent) {
        return (p.z * tangent - std::abs(across)) / std::sqrt(1.0 + tangent * tangent);
    };
    return std::min({side(p.x, view.tan_x), side(p.y, view.tan_y), p.z - view.setup.camera.near_distance,
                     view.setup.camera.far_distance - p.z});
}

// Around the view's edges: some inside, some outside, many touching; the eye in some.
TestScene random_scene(const TestView& view, int count, Random& random) {
    TestScene scene(5);
    const Camera& camera = view.setup.camera;
    for (int i = 0; i < count; ++i) {
        const double z = log_uniform(random, 0.3 * camera.near_distance, 3.0 * camera.far_distance);
        glm::dvec3 place(random.uniform(-1.5, 1.5) * view.tan_x * z, random.uniform(-1.5, 1.5) * view.tan_y * z, z);
        if (random.index(6) == 0) place = random_direction(random) * z;
        double radius = glm::length(place) * log_uniform(random, 1e-5, 2.0);
        const double outside = -depth_inside(view, place);
        if (outside > 0.0 && random.index(3) == 0) radius = outside * random.uniform(0.9999, 1.0001);
        scene.add({camera.eye + view.to_world(place), radius}, random.index(4));
    }
    return scene;
}

SkipSet without_sort() { return SkipSet::all().without(Skip::sort); }

std::set<uint32_t> visible_set(const Frame& frame) {
    return {frame.visible.instances.begin(), frame.visible.instances.end()};
}

TEST(CullInstances, KeepsWhatTouchesTheViewAndLittleElse) {
    int kept = 0, culled = 0, touching = 0;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const TestView view(random_setup(random));
        const TestScene scene = random_scene(view, 400, random);
        const auto visible = visible_set(scene.frame(view.setup));
        for (uint32_t i = 0; i < scene.bounds.size(); ++i) {
            const glm::dvec3 center = to_view(view, scene.bounds[i].center - view.setup.camera.eye);
            const double radius = scene.bounds[i].radius, inside = depth_inside(view, center) + radius;
            touching += std::abs(inside) < 1e-4 * radius ? 1 : 0;
            if (visible.contains(i)) {
                ++kept;
                EXPECT_GT(inside, -1e-5 * (glm::length(center) + radius)) << "seed " << seed << ", instance " << i;
            } else {
                ++culled;
                EXPECT_LT(inside, 0.0) << "seed " << seed << ", instance " << i;
            }
        }
    }
    EXPECT_GT(kept, 30'000);
    EXPECT_GT(culled, 30'000);
    EXPECT_GT(touching, 10'000);
}

// Not by planes but by what pixels show: a point of a sphere on a pixel's ray, between the near and far planes.
TEST(CullInstances, KeepsEverySphereThatAPixelShows) {
    int shown = 0;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        Random random(1000 + seed);
        const TestView view(random_setup(random));
        const double near = view.setup.camera.near_distance, far = view.setup.camera.far_distance;
        TestScene scene;
        for (int i = 0; i < 100; ++i) {
            // Edge pixels, most of the time.
            const auto pixel = [&](int size) {
                const auto any = static_cast<int>(random.index(static_cast<uint64_t>(size)));
                return random.index(3) == 0 ? any : random.index(2) == 0 ? 0 : size - 1;
            };
            const glm::dvec3 ray = view.ray(pixel(view.setup.width), pixel(view.setup.height));
            const double z = random.index(3) == 0 ? near : random.index(2) == 0 ? far : log_uniform(random, near, far);
            const glm::dvec3 point = z * ray;
            const double radius = glm::length(point) * log_uniform(random, 1e-6, 3.0);
            scene.add(
                {view.setup.camera.eye + view.to_world(point + 0.999999 * radius * random_direction(random)), radius});
        }
        const Frame frame = scene.frame(view.setup);
        EXPECT_EQ(frame.visible.instances.size(), scene.bounds.size()) << "seed " << seed;
        shown += static_cast<int>(frame.visible.instances.size());
    }
    EXPECT_EQ(shown, 30'000);
}

// All on a grid of 2^-10, which doubles hold 2^40 from the origin too.
TEST(CullInstances, DoesTheSameFarFromTheOrigin) {
    for (uint64_t seed = 0; seed < 50; ++seed) {
        Random random(seed);
        TestView view(plain_setup());
        const auto on_grid = [&] { return std::round(random.uniform(-10.0, 10.0) * 1024.0) / 1024.0; };
        TestScene near_scene, far_scene;
        const glm::dvec3 away(0x1p40, -0x1p39, 0x1p38);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 center(on_grid(), on_grid(), on_grid());
            const double radius = random.uniform(0.0, 2.0);
            near_scene.add({center, radius});
            far_scene.add({center + away, radius});
        }
        FrameSetup moved = view.setup;
        moved.camera.eye += away;
        moved.camera.target += away;
        const Frame here = near_scene.frame(view.setup), there = far_scene.frame(moved);
        EXPECT_EQ(here.visible.instances, there.visible.instances);
        EXPECT_GT(here.visible.instances.size(), 10U);
        EXPECT_LT(here.visible.instances.size(), 190U);
    }
}

TEST(CullInstances, WhatIsNoNumberIsKept) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::nan("");
    TestScene scene;
    scene.add({{kNaN, 0.0, 0.0}, 1.0});
    scene.add({{0.0, 0.0, 0.0}, kInfinity});
    scene.add({{1e300, -1e300, 1e300}, 1e300});
    scene.add({{0.0, 0.0, 0.0}, kNaN});
    EXPECT_EQ(visible_set(scene.frame(plain_setup())).size(), 4U);
}

TEST(CullInstances, DrawsAreRunsOfTheirBatchAndAreCounted) {
    for (uint64_t seed = 0; seed < 40; ++seed) {
        for (const SkipSet skips : {SkipSet::all(), SkipSet::none()}) {
            Random random(seed);
            TestView view(random_setup(random));
            view.setup.skips = skips;
            const TestScene scene = random_scene(view, 300, random);
            const Frame frame = scene.frame(view.setup);
            std::vector<int> used(frame.visible.instances.size(), 0);
            std::set<uint32_t> batches;
            uint64_t triangles = 0;
            for (const DrawCall& draw : frame.visible.draws) {
                EXPECT_TRUE(batches.insert(draw.batch).second) << "one draw each";
                EXPECT_GT(draw.instance_count, 0U);
                triangles += (draw.batch + 1) * draw.instance_count;
                const auto& own = scene.batches[draw.batch].instances;
                for (uint32_t i = 0; i < draw.instance_count; ++i) {
                    ++used[draw.first_visible + i];
                    EXPECT_TRUE(std::ranges::binary_search(own, frame.visible.instances[draw.first_visible + i]));
                }
            }
            EXPECT_THAT(used, testing::Each(1));
            EXPECT_EQ(visible_set(frame).size(), frame.visible.instances.size()) << "each once";
            EXPECT_EQ(frame.work.draws, frame.visible.draws.size());
            EXPECT_EQ(frame.work.triangles, triangles);
            EXPECT_EQ(frame.work.instances_drawn, frame.visible.instances.size());
            EXPECT_EQ(frame.work.instances_drawn + frame.work.instances_culled, scene.bounds.size());
        }
    }
}

// The instances in the order in which they are drawn.
std::vector<uint32_t> drawn_order(const Frame& frame) {
    std::vector<uint32_t> order;
    for (const DrawCall& draw : frame.visible.draws) {
        const auto first = frame.visible.instances.begin() + draw.first_visible;
        order.insert(order.end(), first, first + draw.instance_count);
    }
    return order;
}

TEST(CullInstances, WithoutTheFrustumAllAreDrawnTheOthersInTheSameOrder) {
    for (uint64_t seed = 0; seed < 60; ++seed) {
        for (const bool sorts : {false, true}) {
            Random random(seed);
            TestView view(random_setup(random));
            view.setup.skips = sorts ? SkipSet::all() : without_sort();
            const TestScene scene = random_scene(view, 300, random);
            const Frame culled = scene.frame(view.setup);
            view.setup.skips = view.setup.skips.without(Skip::frustum);
            const Frame whole = scene.frame(view.setup);
            EXPECT_EQ(whole.visible.instances.size(), scene.bounds.size());
            EXPECT_EQ(whole.work.instances_culled, 0U);
            if (sorts) continue;  // what is nearest of a batch may be culled: then the batch comes later
            auto left = drawn_order(whole);
            const auto visible = visible_set(culled);
            std::erase_if(left, [&](uint32_t i) { return !visible.contains(i); });
            EXPECT_EQ(left, drawn_order(culled));
        }
    }
}

TEST(CullInstances, WithoutSortTheSceneHasTheOrder) {
    Random random(3);
    TestView view(plain_setup());
    view.setup.skips = without_sort();
    const Frame frame = random_scene(view, 500, random).frame(view.setup);
    ASSERT_GT(frame.visible.draws.size(), 2U);
    EXPECT_TRUE(std::ranges::is_sorted(frame.visible.draws, {}, &DrawCall::batch));
    for (const DrawCall& draw : frame.visible.draws) {
        const auto first = frame.visible.instances.begin() + draw.first_visible;
        EXPECT_TRUE(std::is_sorted(first, first + draw.instance_count));
    }
}

TEST(CullInstances, SortDrawsTheSameFrontToBack) {
    for (uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        TestView view(random_setup(random));
        const TestScene scene = random_scene(view, 2000, random);
        const Frame sorted = scene.frame(view.setup);
        view.setup.skips = without_sort();
        const Frame unsorted = scene.frame(view.setup);
        EXPECT_EQ(visible_set(sorted), visible_set(unsorted));
        EXPECT_EQ(sorted.work.triangles, unsorted.work.triangles);

        const auto distance = [&](uint32_t i) {
            return std::max(0.0, glm::dot(scene.bounds[i].center - view.setup.camera.eye, view.forward));
        };
        // What rounding and the margin may take from either of two.
        const auto error = [&](uint32_t i) {
            const InstanceBounds& sphere = scene.bounds[i];
            return 1e-5 * (glm::distance(sphere.center, view.setup.camera.eye) + sphere.radius);
        };
        const auto expect_before = [&](uint32_t a, uint32_t b) {
            EXPECT_LE(distance(a), distance(b) + error(a) + error(b)) << "seed " << seed << ": " << a << ", " << b;
        };
        std::vector<uint32_t> firsts;
        for (const DrawCall& draw : sorted.visible.draws) {
            const uint32_t* instances = sorted.visible.instances.data() + draw.first_visible;
            for (uint32_t i = 1; i < draw.instance_count; ++i) expect_before(instances[i - 1], instances[i]);
            firsts.push_back(instances[0]);
        }
        for (size_t i = 1; i < firsts.size(); ++i) expect_before(firsts[i - 1], firsts[i]);
    }
}

TEST(CullInstances, EquallyNearOnesKeepTheOrderOfTheScene) {
    const TestView view(plain_setup());
    TestScene scene(3);
    // A wall of spheres, seen straight on, one distance for each batch: the last batch is the nearest.
    FrameSetup setup = plain_setup();
    setup.camera.eye = {0.0, 0.0, 8.0};
    setup.camera.target = {0.0, 0.0, 0.0};
    for (int i = 0; i < 900; ++i) scene.add({{0.01 * (i % 30), 0.01 * (i / 30), 0.5 * (i % 3)}, 0.25}, i % 3);
    const Frame frame = scene.frame(setup);
    ASSERT_EQ(frame.visible.draws.size(), 3U);
    EXPECT_EQ(frame.visible.draws[0].batch, 2U);
    EXPECT_EQ(frame.visible.draws[1].batch, 1U);
    EXPECT_EQ(frame.visible.draws[2].batch, 0U);
    for (const DrawCall& draw : frame.visible.draws) {
        EXPECT_THAT(std::span(frame.visible.instances).subspan(draw.first_visible, draw.instance_count),
                    ElementsAreArray(scene.batches[draw.batch].instances));
    }
}

TEST(SortDrawKeys, IsAStableSortByDistance) {
    for (const size_t count : {0, 1, 2, 255, 256, 257, 5000, 70'000}) {
        for (const int kinds : {1, 7, 1'000'000}) {
            Random random(count + static_cast<size_t>(kinds));
            std::vector<uint64_t> keys, scratch{17, 4};
            std::vector<float> distances;
            for (uint32_t i = 0; i < count; ++i) {
                distances.push_back(static_cast<float>(log_uniform(random, 1e-3, 1e6)));
                if (kinds < 10) distances.back() = static_cast<float>(random.index(static_cast<uint64_t>(kinds)));
                keys.push_back(draw_key(distances.back(), i));
            }
            std::vector<uint32_t> expected(count);
            std::iota(expected.begin(), expected.end(), 0U);
            std::ranges::stable_sort(expected, {}, [&](uint32_t i) { return distances[i]; });
            sort_draw_keys(keys, scratch);
            std::vector<uint32_t> order;
            for (const uint64_t key : keys) order.push_back(index_of_key(key));
            ASSERT_EQ(order, expected) << count << " of " << kinds << " kinds";
        }
    }
}

TEST(SortDrawKeys, WhatReachesBehindTheEyeIsNearest) {
    EXPECT_EQ(draw_key(-3.0F, 5), draw_key(0.0F, 5));
    EXPECT_EQ(draw_key(-0.0F, 5), draw_key(0.0F, 5));
    EXPECT_EQ(draw_key(-std::numeric_limits<float>::infinity(), 5), draw_key(0.0F, 5));
    EXPECT_LT(draw_key(-1.0F, 6), draw_key(1e-30F, 5));
    EXPECT_LT(draw_key(1e30F, 5), draw_key(std::numeric_limits<float>::infinity(), 4));
}

// What the shaders' single precision may do to a vertex, and how a mesh is sheared, is in its bounds.
TEST(InstanceBounds, HoldEveryCornerOfTheMesh) {
    for (uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        Bounds mesh;
        for (int i = 0; i < 2; ++i) mesh.include(log_uniform(random, 0.01, 100.0) * random_direction(random));
        glm::dmat4 m(1.0);
        for (int c = 0; c < 3; ++c) m[c] = glm::dvec4(log_uniform(random, 0.1, 10.0) * random_direction(random), 0.0);
        m[3] = glm::dvec4(1e3 * random_direction(random), 1.0);
        const InstanceBounds sphere = instance_bounds(mesh, m);
        double farthest = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p((corner & 1 ? mesh.high : mesh.low).x, (corner & 2 ? mesh.high : mesh.low).y,
                               (corner & 4 ? mesh.high : mesh.low).z);
            // As shaders do it: to_world of shaders/lib/instance.glsl.
            const glm::vec3 q(p);
            const glm::vec3 turned = glm::vec3(m[0]) * q.x + glm::vec3(m[1]) * q.y + glm::vec3(m[2]) * q.z;
            const glm::dvec3 from_center = glm::dvec3(turned) + glm::dvec3(m[3]) - sphere.center;
            farthest = std::max(farthest, glm::length(from_center));
        }
        EXPECT_LE(farthest, sphere.radius) << "seed " << seed;
        EXPECT_GT(farthest, 0.999 * sphere.radius) << "seed " << seed;
    }
}

TEST(InstanceBounds, OfNothingAreAPoint) {
    glm::dmat4 m(1.0);
    m[3] = {1.0, 2.0, 3.0, 1.0};
    const InstanceBounds sphere = instance_bounds(Bounds{}, m);
    EXPECT_EQ(sphere.center, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(sphere.radius, 0.0);
}

}  // namespace
}  // namespace lightsweep
