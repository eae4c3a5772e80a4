// What must hold of random scenes: the real reader takes every one, a seed says everything, and the extremes that they
// are for do come up.
#include "bench/stress/fuzz_scene.h"

#include "renderer/paths/paths.h"
#include "renderer/scene/scene_json.h"

#include <gtest/gtest.h>

#include <set>

namespace lightsweep {
namespace {

constexpr uint64_t kSeeds = 300;

Scene read(const FuzzCase& fuzz_case) {
    return read_scene_json(JsonReader::from_text(fuzz_case.scene.dump(), std::to_string(fuzz_case.seed)));
}

TEST(FuzzScene, EveryOneIsAScene) {
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Scene scene = read(make_fuzz_case(seed));
        EXPECT_FALSE(scene.instances.empty()) << seed;
        EXPECT_EQ(static_cast<size_t>(scene.lights.default_count), scene.lights.fixed.size()) << seed;
    }
}

TEST(FuzzScene, FollowsFromItsSeedAlone) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
        const FuzzCase a = make_fuzz_case(seed), b = make_fuzz_case(seed);
        EXPECT_EQ(a.scene, b.scene);
        EXPECT_EQ(a.cells, b.cells);
    }
    EXPECT_NE(make_fuzz_case(1).scene, make_fuzz_case(2).scene);
}

TEST(FuzzScene, CellsAreOfOnePictureAndDifferInTheirPaths) {
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
        const FuzzCase fuzz_case = make_fuzz_case(seed);
        std::set<std::string> paths;
        for (const CellParams& cell : fuzz_case.cells) {
            EXPECT_TRUE(paths.insert(cell.path).second);
            EXPECT_EQ(cell.group(), fuzz_case.cells.front().group());
            EXPECT_EQ(cell.layout.empty(), !find_path(cell.path).uses_layout);
            EXPECT_EQ(cell.light_lists.empty(), !find_path(cell.path).uses_light_lists);
            EXPECT_LE(std::max(cell.width, cell.height), 96);
        }
        EXPECT_GE(paths.size(), 2U);
    }
}

TEST(FuzzScene, ReachesTheExtremes) {
    int pixels_wide = 0, dark = 0, far_away = 0, mirrors = 0, without_lights = 0, many_lights = 0, at_the_eye = 0;
    std::set<std::string> paths, layouts, hdrs, models;
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
        const FuzzCase fuzz_case = make_fuzz_case(seed);
        const Scene scene = read(fuzz_case);
        pixels_wide += fuzz_case.cells.front().width == 1;
        far_away += glm::length(scene.camera.eye) > 1e5;
        without_lights += scene.lights.fixed.empty();
        many_lights += scene.lights.fixed.size() > 100;
        for (const Light& light : scene.lights.fixed) {
            dark += light.color == glm::dvec3(0.0);
            at_the_eye += light.kind != LightKind::directional && light.position == scene.camera.eye;
        }
        for (const Material& material : scene.materials) {
            mirrors += material.roughness == 0.0F;
            models.insert(kShadingModelNames[static_cast<size_t>(material.model)]);
        }
        for (const CellParams& cell : fuzz_case.cells) {
            paths.insert(cell.path);
            layouts.insert(cell.layout);
            hdrs.insert(cell.hdr);
        }
    }
    for (const int count : {pixels_wide, dark, far_away, mirrors, without_lights, many_lights, at_the_eye}) {
        EXPECT_GT(count, 0);
    }
    EXPECT_EQ(paths.size(), path_keys().size());
    EXPECT_EQ(models.size(), static_cast<size_t>(kShadingModelCount));
    EXPECT_EQ(hdrs.size(), kHdrFormats.size());
    EXPECT_GT(layouts.size(), 15U);
}

}  // namespace
}  // namespace lightsweep
