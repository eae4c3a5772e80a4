// Lists of lights: nothing that shines is left out, they are what the shared test says cell by cell, and not much more
// than must be is in them.
#include "tests/unit/frame/lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace lightsweep {
namespace {

using shared::LightBounds;
using shared::LightGridData;
using testing::ElementsAreArray;

struct Listed {
    LightGridData grid;
    std::vector<LightBounds> bounds;
    LightLists lists;
};

Listed list_lights(const Frame& frame, const LightGridDesc& desc, double position_error = 0.0) {
    Listed listed;
    light_bounds(frame, position_error, listed.bounds);
    listed.grid = make_light_grid(desc, frame.setup, listed.bounds);
    build_light_lists(listed.grid, listed.bounds, {}, 0, listed.lists);
    return listed;
}

struct Check {
    int reached = 0;  // pairs of a light and a point that it shines on
    int missed = 0;   // of them, those whose light is not in the list of the point's cell
    int listed = 0;
};

Check check(const Frame& frame, const TestView& view, const LightGridData& grid, const LightLists& lists,
            std::span<const SurfacePoint> points) {
    Check result;
    for (const SurfacePoint& point : points) {
        const auto list = lights_of_cell(lists, cell_of(grid, point));
        result.listed += static_cast<int>(list.size());
        for (uint32_t i = 0; i < frame.lights.size(); ++i) {
            if (!reaches(frame.lights[i], view.to_world(point.read))) continue;
            ++result.reached;
            if (!std::binary_search(list.begin(), list.end(), i)) ++result.missed;
        }
    }
    return result;
}

std::vector<SurfacePoint> random_points(const TestView& view, const Frame& frame, double error, int count,
                                        Random& random) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < count; ++i) points.push_back(random_point(view, frame, error, random));
    return points;
}

// The depths of the tiles, from points: what they are read at, since shading is what makes depths.
std::vector<DepthRange> depths_of(const LightGridData& grid, std::span<const SurfacePoint> points) {
    std::vector<DepthRange> depths(cell_count(grid), {1e30F, -1e30F});
    for (const SurfacePoint& point : points) {
        DepthRange& range = depths[cell_of(grid, point)];
        range.low = std::min(range.low, static_cast<float>(point.read.z));
        range.high = std::max(range.high, static_cast<float>(point.read.z));
    }
    return depths;
}

const double kErrors[] = {0.0, 0x1p-10, 0x1p-5};

class EveryGrid : public testing::TestWithParam<LightGridDesc> {};
INSTANTIATE_TEST_SUITE_P(All, EveryGrid,
                         testing::Values(LightGridDesc{.tile_px = 1}, LightGridDesc{.tile_px = 16},
                                         LightGridDesc{.tile_px = 1, .slices = true},
                                         LightGridDesc{.tile_px = 7, .slices = true},
                                         LightGridDesc{.tile_px = 32, .slices = true},
                                         LightGridDesc{.tile_px = 1, .depth_bounds = true},
                                         LightGridDesc{.tile_px = 16, .depth_bounds = true}),
                         [](const auto& test) {
                             return "px" + std::to_string(test.param.tile_px) +
                                    (test.param.slices         ? "_slices"
                                     : test.param.depth_bounds ? "_depths"
                                                               : "");
                         });

TEST_P(EveryGrid, NoLightThatReachesASurfaceIsLeftOut) {
    Check total;
    for (uint64_t seed = 0; seed < 240; ++seed) {
        Random random(seed);
        const double error = kErrors[seed % 3];
        const TestView view(random_setup(random));
        const Frame frame = frame_of(view.setup, random_lights(view, 24, random));
        const auto points = random_points(view, frame, error, 400, random);
        Listed listed = list_lights(frame, GetParam(), error);
        if (GetParam().depth_bounds) {
            build_light_lists(listed.grid, listed.bounds, depths_of(listed.grid, points), 0, listed.lists);
        }
        const Check result = check(frame, view, listed.grid, listed.lists, points);
        EXPECT_EQ(result.missed, 0) << "seed " << seed << ", " << result.reached << " reached";
        total.reached += result.reached;
    }
    EXPECT_GT(total.reached, 50'000) << "else the above says little";
}

TEST_P(EveryGrid, ALightWithoutAnEndIsInEveryList) {
    const TestView view(plain_setup(64, 36));
    for (const double radius : {1e15, 1e30, std::numeric_limits<double>::infinity()}) {
        const Light light{.position = view.setup.camera.eye + glm::dvec3(3.0, -2.0, 1.0), .radius = radius};
        const Frame frame = frame_of(view.setup, {light});
        const Listed listed = list_lights(frame, GetParam());
        for (size_t cell = 0; cell < cell_count(listed.grid); ++cell) {
            EXPECT_EQ(lights_of_cell(listed.lists, cell).size(), 1U) << "radius " << radius << ", cell " << cell;
        }
    }
}

TEST_P(EveryGrid, ListsAreThoseOfTestingEveryCell) {
    for (uint64_t seed = 0; seed < 120; ++seed) {
        Random random(1000 + seed);
        const TestView view(random_setup(random));
        const Frame frame = frame_of(view.setup, random_lights(view, 30, random));
        std::vector<LightBounds> bounds;
        light_bounds(frame, kErrors[seed % 3], bounds);
        const LightGridData grid = make_light_grid(GetParam(), view.setup, bounds);
        std::vector<DepthRange> depths;
        if (GetParam().depth_bounds) {
            depths = depths_of(grid, random_points(view, frame, 0.0, static_cast<int>(cell_count(grid)), random));
        }
        LightLists lists;
        build_light_lists(grid, bounds, depths, 5, lists);

        ASSERT_EQ(lists.cells.size(), cell_count(grid));
        uint32_t offset = 0;
        size_t cell = 0;
        for (uint32_t slice = 0; slice < grid.slices; ++slice) {
            for (uint32_t y = 0; y < grid.tiles_y; ++y) {
                for (uint32_t x = 0; x < grid.tiles_x; ++x, ++cell) {
                    const DepthRange range = depths.empty() ? DepthRange{shared::slice_begin(grid, slice),
                                                                         shared::slice_begin(grid, slice + 1)}
                                                            : depths[cell];
                    const auto shape = shared::cell_bounds(grid, x, y, range.low, range.high);
                    std::vector<uint32_t> expected;
                    for (uint32_t i = 0; i < bounds.size(); ++i) {
                        if (shared::light_touches_cell(bounds[i], shape)) expected.push_back(5 + i);
                    }
                    ASSERT_THAT(lights_of_cell(lists, cell), ElementsAreArray(expected))
                        << "seed " << seed << ", slice " << slice << ", row " << y << ", column " << x;
                    ASSERT_EQ(lists.cells[cell].offset, offset);
                    offset += lists.cells[cell].count;
                }
            }
        }
        EXPECT_EQ(lists.indices.size(), offset);
    }
}

TEST_P(EveryGrid, OrderOfTheLightsOrdersTheLists) {
    Random random(7);
    const TestView view(plain_setup());
    const Frame frame = frame_of(view.setup, random_lights(view, 100, random));
    Listed listed = list_lights(frame, GetParam());
    std::vector<uint32_t> order(listed.bounds.size());
    std::iota(order.begin(), order.end(), 0U);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    std::vector<LightBounds> shuffled;
    for (const uint32_t i : order) shuffled.push_back(listed.bounds[i]);

    LightLists lists;
    build_light_lists(make_light_grid(GetParam(), view.setup, shuffled), shuffled, {}, 0, lists);
    ASSERT_EQ(lists.cells, listed.lists.cells) << "counts do not depend on the order";
    ASSERT_GT(lists.indices.size(), 1000U);
    for (size_t cell = 0; cell < lists.cells.size(); ++cell) {
        std::vector<uint32_t> lights;
        for (const uint32_t i : lights_of_cell(lists, cell)) lights.push_back(order[i]);
        std::sort(lights.begin(), lights.end());
        ASSERT_THAT(lights_of_cell(listed.lists, cell), ElementsAreArray(lights)) << "cell " << cell;
    }
}

TEST(LightLists, ReuseOfTheirMemoryLeavesNothingBehind) {
    Random random(8);
    const TestView view(plain_setup());
    const Frame many = frame_of(view.setup, random_lights(view, 200, random));
    const Frame few = frame_of(view.setup, random_lights(view, 10, random));
    const LightGridDesc desc{.tile_px = 32, .slices = true};
    Listed listed = list_lights(many, desc);
    Listed fresh = list_lights(few, desc);
    build_light_lists(fresh.grid, fresh.bounds, {}, 0, listed.lists);
    EXPECT_EQ(listed.lists.cells, fresh.lists.cells);
    EXPECT_EQ(listed.lists.indices, fresh.lists.indices);
}

TEST(LightLists, TileThatShowsNothingHasNoLights) {
    const TestView view(plain_setup());
    Light light{.position = view.setup.camera.eye, .radius = 50.0};
    Listed listed = list_lights(frame_of(view.setup, {light}), {.tile_px = 16, .depth_bounds = true});
    std::vector<DepthRange> depths(cell_count(listed.grid), {1.0F, 2.0F});
    depths[3] = {1e30F, -1e30F};
    build_light_lists(listed.grid, listed.bounds, depths, 0, listed.lists);
    EXPECT_EQ(listed.lists.cells[2].count, 1U);
    EXPECT_EQ(listed.lists.cells[3].count, 0U);
    EXPECT_EQ(listed.lists.indices.size(), depths.size() - 1);
}

// Cells of single pixels and surfaces: they hide no mistake.
const LightGridDesc kFinest{.tile_px = 1, .depth_bounds = true};

// What the checks above must be able to see: bounds that are a little wrong.
struct Fault {
    const char* name;
    void (*plant)(LightBounds&);
};
class EveryFault : public testing::TestWithParam<Fault> {};
INSTANTIATE_TEST_SUITE_P(All, EveryFault,
                         testing::Values(Fault{"mirrored_x", [](LightBounds& b) { b.center.x = -b.center.x; }},
                                         Fault{"mirrored_y", [](LightBounds& b) { b.center.y = -b.center.y; }},
                                         Fault{"flipped_axis", [](LightBounds& b) { b.axis = -b.axis; }},
                                         Fault{"narrow_cone",
                                               [](LightBounds& b) {
                                                   b.cos_half_angle = std::min(1.0F, b.cos_half_angle * 1.05F);
                                               }},
                                         Fault{"short_range", [](LightBounds& b) { b.range *= 0.97F; }},
                                         Fault{"small_radius", [](LightBounds& b) { b.radius *= 0.97F; }}),
                         [](const auto& test) { return test.param.name; });

TEST_P(EveryFault, IsSeen) {
    Random random(9);
    const TestView view(plain_setup(640, 360));
    const Frame frame = frame_of(view.setup, random_lights(view, 60, random));
    const auto points = random_points(view, frame, 0.0, 20'000, random);
    Listed listed = list_lights(frame, kFinest);
    const auto depths = depths_of(listed.grid, points);
    build_light_lists(listed.grid, listed.bounds, depths, 0, listed.lists);
    ASSERT_EQ(check(frame, view, listed.grid, listed.lists, points).missed, 0);
    for (LightBounds& bounds : listed.bounds) GetParam().plant(bounds);
    build_light_lists(listed.grid, listed.bounds, depths, 0, listed.lists);
    EXPECT_GT(check(frame, view, listed.grid, listed.lists, points).missed, 0);
}

TEST(LightLists, BoundsThatAreNotGrownMissSurfacesThatAreReadElsewhere) {
    Random random(10);
    const double error = 0x1p-7;
    const TestView view(plain_setup(640, 360));
    const Frame frame = frame_of(view.setup, random_lights(view, 60, random));
    const auto points = random_points(view, frame, error, 20'000, random);
    for (const double promised : {error, 0.0}) {
        Listed listed = list_lights(frame, kFinest, promised);
        build_light_lists(listed.grid, listed.bounds, depths_of(listed.grid, points), 0, listed.lists);
        const int missed = check(frame, view, listed.grid, listed.lists, points).missed;
        EXPECT_EQ(missed > 0, promised == 0.0) << missed << " missed";
    }
}

// A cell lists what reaches any of it: here cells are an eighth of the lights' radius or less, and a ball dilated by
// that much is 1.4 times as large. Spots have less volume for their surface.
TEST(LightLists, AreNotMuchLongerThanMustBe) {
    for (const bool spots : {false, true}) {
        Random random(11);
        const TestView view(plain_setup(1280, 720));
        std::vector<Light> lights;
        for (int i = 0; i < 300; ++i) {
            const double z = random.uniform(6.0, 10.0);
            const glm::dvec3 place(random.uniform(-1.0, 1.0) * view.tan_x * z,
                                   random.uniform(-1.0, 1.0) * view.tan_y * z, z);
            lights.push_back({.kind = spots ? LightKind::spot : LightKind::point,
                              .position = view.setup.camera.eye + view.to_world(place),
                              .direction = random_direction(random),
                              .radius = 2.5,
                              .outer_deg = 40.0});
        }
        const Frame frame = frame_of(view.setup, lights);
        std::vector<SurfacePoint> points;
        for (int i = 0; i < 5000; ++i) {
            SurfacePoint point{static_cast<int>(random.index(1280)), static_cast<int>(random.index(720)), {}, {}};
            point.place = point.read = random.uniform(6.0, 10.0) * view.ray(point.x, point.y);
            points.push_back(point);
        }
        Listed listed = list_lights(frame, {.tile_px = 32, .slices = true});
        const Check tight = check(frame, view, listed.grid, listed.lists, points);
        EXPECT_LT(tight.listed, (spots ? 2.5 : 1.4) * tight.reached);
        if (!spots) continue;
        for (LightBounds& bounds : listed.bounds) {
            bounds.center = bounds.apex;
            bounds.radius = bounds.range;
            bounds.cos_half_angle = -1.0F;
        }
        build_light_lists(listed.grid, listed.bounds, {}, 0, listed.lists);
        EXPECT_LT(tight.listed, 0.5 * check(frame, view, listed.grid, listed.lists, points).listed)
            << "against spheres around all of the range";
    }
}

}  // namespace
}  // namespace lightsweep
