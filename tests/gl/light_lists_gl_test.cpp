// Both builders' light lists on a real context: the same lists, none that misses a light, and room for all of them.
#include "renderer/base/error.h"
#include "renderer/base/random.h"
#include "renderer/frame/light_list_service.h"
#include "renderer/gl/context.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/state.h"
#include "shaders/shared/light_cell.h"
#include "shaders/shared/slots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lightsweep {
namespace {

using testing::HasSubstr;

// The eye is at (3, 1, -2), among the lights when they are spread over a few metres.
Camera camera() {
    return {.eye = {3.0, 1.0, -2.0}, .target = {2.0, 0.5, -9.0}, .fov_y_deg = 70.0, .far_distance = 60.0};
}

std::vector<Light> random_lights(size_t count, double spread, double radius, uint64_t seed) {
    Random random(seed);
    const auto within = [&](double size) {
        return glm::dvec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
    };
    std::vector<Light> lights{{.kind = LightKind::directional}};  // so that indices do not begin at 0
    while (lights.size() <= count) {
        Light light{.position = camera().eye + within(spread), .direction = glm::normalize(within(1.0))};
        light.radius = radius * random.uniform(0.1, 2.0);
        if (lights.size() % 3 == 0) {
            light.kind = LightKind::spot;
            light.outer_deg = random.uniform(2.0, 89.0);
            light.inner_deg = 0.5 * light.outer_deg;
        }
        lights.push_back(light);
    }
    return lights;
}

// A frame of nothing but lights, uploaded.
class LitFrame {
  public:
    LitFrame(int width, int height, const std::vector<Light>& lights) : scene_(kNothing, SceneNeeds{}) {
        build_frame(scene_, lights, {.camera = camera(), .width = width, .height = height}, frame);
        buffers_.upload(frame);
        buffers_.bind(scene_);
    }
    Frame frame;

  private:
    inline static const Scene kNothing{};
    FrameBuffers buffers_;
    GpuScene scene_;
};

// Ranges of surfaces: most tiles show some, some a single distance, some none.
gl::Texture random_depths(const shared::LightGridData& grid, uint64_t seed) {
    Random random(seed);
    gl::Texture texture({.width = static_cast<int>(grid.tiles_x),
                         .height = static_cast<int>(grid.tiles_y),
                         .format = gl::Format::RG32F,
                         .label = "tile depths"});
    std::vector<float> texels;
    for (uint32_t i = 0; i < grid.tiles_x * grid.tiles_y; ++i) {
        const double low = random.uniform(0.1, 20.0), depth = i % 5 == 0 ? 0.0 : random.uniform(0.0, 20.0);
        const bool empty = i % 7 == 3;
        texels.insert(texels.end(), {empty ? 1e30F : static_cast<float>(low),
                                     empty ? 0.0F : static_cast<float>(low + depth), 0.0F, 0.0F});
    }
    texture.upload_floats(texels);
    return texture;
}

struct Built {
    shared::LightGridData grid;
    LightLists lists;
};

Built build(const LightGridDesc& desc, ListBuilder builder, const Frame& frame, const gl::Texture* depths) {
    LightListService service(desc, builder, 0.0);
    service.build(frame, depths);
    if (service.grow_if_cut_short()) service.build(frame, depths);
    EXPECT_FALSE(service.grow_if_cut_short());
    return {service.grid(), service.read()};
}

std::vector<uint32_t> list_of(const LightLists& lists, size_t cell) {
    const auto begin = lists.indices.begin() + lists.cells[cell].offset;
    return {begin, begin + lists.cells[cell].count};
}

shared::LightBounds resized(shared::LightBounds light, float share) {
    const float growth = share * (glm::length(light.center) + light.radius);
    light.radius += growth;
    light.range += growth;
    light.cos_half_angle -= share;
    return light;
}

// Shaders may round otherwise than the CPU, so a light that only just touches may be in one of two lists.
void expect_same_lists(const Built& cpu, const Built& compute, const Frame& frame, const gl::Texture* depths) {
    constexpr float kRounding = 1e-5F;
    ASSERT_EQ(cpu.lists.cells.size(), compute.lists.cells.size());
    std::vector<shared::LightBounds> bounds;
    light_bounds(frame, 0.0, bounds);
    const std::vector<float> ranges = depths == nullptr ? std::vector<float>{} : depths->read_floats(2);
    const shared::LightGridData& grid = cpu.grid;
    size_t differences = 0;
    for (size_t i = 0; i < cpu.lists.cells.size(); ++i) {
        const std::vector<uint32_t> a = list_of(cpu.lists, i), b = list_of(compute.lists, i);
        ASSERT_TRUE(std::is_sorted(b.begin(), b.end())) << "cell " << i;
        std::vector<uint32_t> in_one;
        std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(in_one));
        differences += in_one.size();
        const auto tile = static_cast<uint32_t>(i) % (grid.tiles_x * grid.tiles_y);
        const auto slice = static_cast<uint32_t>(i) / (grid.tiles_x * grid.tiles_y);
        const shared::CellBounds cell =
            shared::cell_bounds(grid, tile % grid.tiles_x, tile / grid.tiles_x,
                                ranges.empty() ? shared::slice_begin(grid, slice) : ranges[2 * tile],
                                ranges.empty() ? shared::slice_begin(grid, slice + 1) : ranges[2 * tile + 1]);
        for (const uint32_t index : in_one) {
            const shared::LightBounds& light = bounds.at(index - frame.data.directional_count);
            ASSERT_NE(shared::light_touches_cell(resized(light, kRounding), cell),
                      shared::light_touches_cell(resized(light, -kRounding), cell))
                << "light " << index << ", cell " << i << ", in one list of " << a.size() << " and " << b.size();
        }
    }
    EXPECT_LE(differences, 2 + cpu.lists.indices.size() / 1000);
}

struct GridCase {
    const char* name;
    LightGridDesc desc;
};

constexpr GridCase kGrids[] = {
    {"clusters", {.tile_px = 32, .slices = true}},
    {"small clusters", {.tile_px = 8, .slices = true}},
    {"tiles", {.tile_px = 16}},
    {"tiles with depths", {.tile_px = 16, .depth_bounds = true}},
};

TEST(LightLists, BothBuildersListTheSameLights) {
    struct Case {
        size_t count;
        double spread, radius;
        int width, height;
    };
    constexpr Case kCases[] = {
        {0, 10.0, 1.0, 157, 83},  {1, 2.0, 5.0, 157, 83},     {31, 5.0, 2.0, 64, 64},     {32, 5.0, 2.0, 1, 1},
        {33, 5.0, 20.0, 157, 83}, {1500, 20.0, 1.0, 157, 83}, {5000, 30.0, 0.5, 83, 157}, {5000, 30.0, 3.0, 320, 180},
    };
    for (const Case& c : kCases) {
        const LitFrame lit(c.width, c.height, random_lights(c.count, c.spread, c.radius, c.count + 1));
        for (const GridCase& g : kGrids) {
            SCOPED_TRACE(testing::Message() << c.count << " lights, " << c.width << "x" << c.height << ", " << g.name);
            const shared::LightGridData grid = make_light_grid(g.desc, lit.frame.setup, {});
            const gl::Texture depths = random_depths(grid, 5);
            const gl::Texture* given = g.desc.depth_bounds ? &depths : nullptr;
            const Built cpu = build(g.desc, ListBuilder::cpu, lit.frame, given);
            const Built compute = build(g.desc, ListBuilder::compute, lit.frame, given);
            expect_same_lists(cpu, compute, lit.frame, given);
        }
    }
}

// Worked out from the lights themselves: at random places in the view, those that shine there must be listed.
TEST(LightLists, NoLightIsMissed) {
    const LitFrame lit(157, 83, random_lights(2000, 15.0, 3.0, 7));
    const Frame& frame = lit.frame;
    const LightGridDesc desc{.tile_px = 16, .slices = true};
    for (const ListBuilder builder : {ListBuilder::cpu, ListBuilder::compute}) {
        const Built built = build(desc, builder, frame, nullptr);
        const shared::LightGridData& grid = built.grid;
        Random random(3);
        size_t found = 0;
        for (int i = 0; i < 2000; ++i) {
            const double px = random.uniform(0.0, 157.0), py = random.uniform(0.0, 83.0);
            const double z = std::exp(random.uniform(std::log(0.1), std::log(60.0)));
            const glm::dvec3 place =
                z * ((px / 157.0 * 2.0 - 1.0) * glm::dvec3(frame.data.ray_right) +
                     (py / 83.0 * 2.0 - 1.0) * glm::dvec3(frame.data.ray_up) + glm::dvec3(frame.data.ray_forward));
            const uint32_t cell = (shared::slice_of(grid, static_cast<float>(z)) * grid.tiles_y +
                                   static_cast<uint32_t>(py / grid.tile_px)) *
                                      grid.tiles_x +
                                  static_cast<uint32_t>(px / grid.tile_px);
            const std::vector<uint32_t> list = list_of(built.lists, cell);
            for (uint32_t l = frame.data.directional_count; l < frame.lights.size(); ++l) {
                const shared::LightData& light = frame.lights[l];
                const glm::dvec3 to_place = place - glm::dvec3(light.position);
                const double spot =
                    glm::dot(glm::normalize(to_place), glm::dvec3(light.direction)) * double{light.spot_scale} +
                    double{light.spot_offset};
                if (glm::length(to_place) >= double{light.radius} || spot <= 0.0) continue;
                ++found;
                EXPECT_TRUE(std::binary_search(list.begin(), list.end(), l)) << "light " << l << ", cell " << cell;
            }
        }
        EXPECT_GT(found, 2000U);  // the places are not all dark
    }
}

TEST(LightLists, ListsThatAreCutShortGetRoom) {
    // Every light reaches all of the view: each of the cells wants 3000 indices, far more than there is room for.
    const LitFrame lit(157, 83, random_lights(3000, 1.0, 1000.0, 1));
    const LightGridDesc desc{.tile_px = 32, .slices = true};
    LightListService service(desc, ListBuilder::compute, 0.0);
    service.build(lit.frame, nullptr);
    const size_t before = service.memory_bytes();
    EXPECT_TRUE(service.grow_if_cut_short());
    EXPECT_GT(service.memory_bytes(), before);
    service.build(lit.frame, nullptr);
    EXPECT_FALSE(service.grow_if_cut_short());
    const Built cpu = build(desc, ListBuilder::cpu, lit.frame, nullptr);
    expect_same_lists(cpu, {service.grid(), service.read()}, lit.frame, nullptr);
}

TEST(LightLists, AServiceServesFramesOfAnySize) {
    const LightGridDesc desc{.tile_px = 16, .slices = true};
    LightListService service(desc, ListBuilder::compute, 0.0);
    for (const size_t count : {size_t{2000}, size_t{0}, size_t{40}}) {
        const LitFrame lit(157, 83, random_lights(count, 10.0, 2.0, 9));
        service.build(lit.frame, nullptr);
        if (service.grow_if_cut_short()) service.build(lit.frame, nullptr);
        ASSERT_FALSE(service.grow_if_cut_short());
        expect_same_lists(build(desc, ListBuilder::cpu, lit.frame, nullptr), {service.grid(), service.read()},
                          lit.frame, nullptr);
    }
}

TEST(LightLists, SaysWhichLimitIsTooSmall) {
    // A million tiles with a row of 64 Ki bits each are 8 GiB.
    const LitFrame lit(16384, 16384, random_lights(65536, 20.0, 0.1, 1));
    LightListService service({.tile_px = 16}, ListBuilder::compute, 0.0);
    try {
        service.build(lit.frame, nullptr);
        FAIL() << "not refused";
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("max_"));
        EXPECT_THAT(error.what(), HasSubstr("light masks"));
    }
}

// A driver that ends long loops would lose the last lights of a list, without a word: neither may the compute shader
// write such a list, nor may shading walk it.
TEST(LightLists, RefuseToBeLongerThanShadersLoop) {
    const auto rounds = static_cast<size_t>(gl::Context::current()->limits().max_loop_rounds);
    if (rounds > 1'000'000) GTEST_SKIP() << "this device ends no loop";
    // Two in three are points, and each of those reaches all that is seen.
    const LitFrame lit(8, 8, random_lights(2 * rounds, 0.1, 10'000.0, 3));
    for (const ListBuilder builder : {ListBuilder::cpu, ListBuilder::compute}) {
        LightListService service({.tile_px = 16}, builder, 0.0);
        try {
            service.build(lit.frame, nullptr);
            while (service.grow_if_cut_short()) service.build(lit.frame, nullptr);
            ADD_FAILURE() << list_builder_names()[static_cast<size_t>(builder)] << ": not refused";
        } catch (const EnvironmentError& error) {
            EXPECT_THAT(error.what(), HasSubstr("max_loop_rounds"));
        }
    }
}

// The depth of a surface at the view distance z; see camera_projection.
float depth_at(const shared::FrameData& data, double z) {
    return static_cast<float>(double{data.depth_scale} / z - double{data.depth_offset} + double{data.depth_clear});
}

TEST(LightLists, TilesEndWhereTheirSurfacesDo) {
    constexpr int kWidth = 37, kHeight = 21, kTile = 8, kTilesX = 5, kTilesY = 3;
    for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
        const Scene nothing;
        const GpuScene scene(nothing, SceneNeeds{});
        Frame frame;
        build_frame(scene, {}, {camera(), kWidth, kHeight, convention}, frame);
        FrameBuffers buffers;
        buffers.upload(frame);
        buffers.bind(scene);

        // Each tile (x, y) shows distances from 1 + x + y to that times 1.5, in its own corners; one tile shows none,
        // one a single surface, and background is everywhere between.
        const auto texel = [&](int x, int y) {
            const int tx = x / kTile, ty = y / kTile;
            const double low = 1.0 + tx + ty;
            if (tx == 1 && ty == 1) return frame.data.depth_clear;
            const bool first = x % kTile == 0 && y % kTile == 0;
            const bool last =
                x == std::min(kWidth, (tx + 1) * kTile) - 1 && y == std::min(kHeight, (ty + 1) * kTile) - 1;
            if (tx == 2 && ty == 0) return first ? depth_at(frame.data, low) : frame.data.depth_clear;
            if (last) return depth_at(frame.data, low * 1.5);
            return first ? depth_at(frame.data, low) : frame.data.depth_clear;
        };
        std::vector<float> texels;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) texels.insert(texels.end(), {texel(x, y), 0.0F, 0.0F, 0.0F});
        }
        gl::Texture depth({.width = kWidth, .height = kHeight, .format = gl::Format::R32F, .label = "depth"});
        depth.upload_floats(texels);
        const gl::Texture ranges(
            {.width = kTilesX, .height = kTilesY, .format = gl::Format::RG32F, .label = "tile depths"});
        const gl::Texture* const colors[] = {&ranges};
        const gl::Framebuffer target(colors, nullptr, "tile depths");
        const gl::VertexArray no_attributes({}, {}, "none");
        const gl::Program program({.vertex = "paths/fullscreen.vert.glsl",
                                   .fragment = "lists/tile_depth.frag.glsl",
                                   .defines = {"TILE_PX 8", "DEPTH_STEP 0.0"}});
        target.bind();
        no_attributes.bind();
        program.use();
        gl::apply({});
        depth.bind(shared::kTargetUnit);
        gl::draw_triangles(3);

        const std::vector<float> result = ranges.read_floats(2);
        for (int ty = 0; ty < kTilesY; ++ty) {
            for (int tx = 0; tx < kTilesX; ++tx) {
                const float low = result[2 * (ty * kTilesX + tx)], high = result[2 * (ty * kTilesX + tx) + 1];
                const float expected = 1.0F + static_cast<float>(tx + ty);
                if (tx == 1 && ty == 1) {
                    EXPECT_GT(low, high);
                } else {
                    EXPECT_NEAR(low, expected, 1e-3F * expected) << tx << ", " << ty;
                    const float deepest = tx == 2 && ty == 0 ? expected : 1.5F * expected;
                    EXPECT_NEAR(high, deepest, 1e-3F * deepest) << tx << ", " << ty;
                }
            }
        }
    }
}

}  // namespace
}  // namespace lightsweep
