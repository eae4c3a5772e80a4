// What must hold for paths that shade with light lists: the picture is the one of their plain twin, which evaluates
// every light, whatever stands where. A light that is listed but does not reach adds exactly zero, and lists rise, so
// the sums are the same ones in the same order.
#include "tests/gl/fixture.h"
#include "tests/gl/unruly_lights.h"

#include <algorithm>
#include <map>
#include <ostream>

namespace lightsweep {
namespace {

// The same operations on the same numbers; a compiler may fuse them differently in another loop.
constexpr double kRelative = 1e-6, kAbsolute = 1e-7;

struct Case {
    std::string path, light_lists;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.path << " " << c.light_lists; }

class LightGrids : public testing::TestWithParam<Case> {
  protected:
    std::string twin() const { return find_path(GetParam().path).uses_layout ? "deferred" : "forward_prepass"; }

    void expect_twins(Studio& studio, const std::vector<Light>& lights, const std::string& what,
                      const std::string& layout = "float32") {
        studio.light_lists = GetParam().light_lists;
        expect_close(studio.hdr(twin(), layout, lights), studio.hdr(GetParam().path, layout, lights), kRelative,
                     kAbsolute, what);
    }
};

std::vector<Case> every_path_with_lists() {
    std::vector<Case> cases;
    for (const auto& path : path_keys()) {
        if (!find_path(path).uses_light_lists) continue;
        for (const auto& builder : list_builder_names()) cases.push_back({path, builder});
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Paths, LightGrids, testing::ValuesIn(every_path_with_lists()),
                         [](const auto& c) { return c.param.path + "_" + c.param.light_lists; });

TEST_P(LightGrids, EqualTheirTwinAtAnySize) {
    Studio studio("atrium");
    for (const auto& [width, height] : {std::pair{157, 83}, {16, 16}, {33, 1}, {1, 33}, {320, 180}}) {
        studio.width = width;
        studio.height = height;
        expect_twins(studio, studio.lights(200), std::to_string(width) + "x" + std::to_string(height));
    }
}

// Planks behind planks, with light in the gaps: tiles whose depths lie far apart.
TEST_P(LightGrids, EqualTheirTwinAtDepthDiscontinuities) {
    for (const auto* scene : {"overdraw", "spheres", "materials"}) {
        Studio studio(scene);
        expect_twins(studio, unruly_lights(studio.scene(), 150, 5), scene);
    }
}

TEST_P(LightGrids, EqualTheirTwinWithUnrulyLights) {
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        Studio studio(seed % 2 == 0 ? "materials" : "atrium");
        studio.width = 157;
        expect_twins(studio, unruly_lights(studio.scene(), 120, seed), "seed " + std::to_string(seed));
    }
}

// Positions that a layout stores coarsely must not lose the lights that reach them.
TEST_P(LightGrids, EqualTheirTwinWithEveryLayout) {
    if (twin() == "forward_prepass") GTEST_SKIP() << "takes no layout";
    Studio studio("materials");
    const auto lights = unruly_lights(studio.scene(), 100, 9);
    for (const auto& layout : layout_keys()) expect_twins(studio, lights, layout, layout);
}

TEST_P(LightGrids, ManyLights) {
    Studio studio("atrium");
    // The twin's frame evaluates 14,400 px x 4,096 lights.
    expect_twins(studio, make_lights(studio.scene(), 4096, {16.0}), "4,096 lights");
}

}  // namespace
}  // namespace lightsweep
