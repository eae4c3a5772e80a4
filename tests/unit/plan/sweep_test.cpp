#include "bench/plan/sweep.h"

#include "test_catalog.h"

#include "renderer/base/resources.h"

#include <gmock/gmock.h>

#include <set>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::vector<std::string> cell_names(const std::string& blocks, const AxisValues& overrides = {}) {
    const auto sweep = parse_sweep(R"({"summary": "s", "blocks": )" + blocks + "}", "sweep.json", test_catalog());
    std::vector<std::string> names;
    for (const auto& cell : sweep_cells(sweep, overrides, test_catalog())) names.push_back(cell.name());
    return names;
}

TEST(Sweep, a_block_is_the_product_of_its_axes) {
    EXPECT_THAT(
        cell_names(R"([{"scene": "cornell", "lights": [1, 2], "path": "deferred", "layout": ["oct16", "oct32"]}])"),
        ElementsAre("scene=cornell lights=1 size=640x360 path=deferred layout=oct16 hdr=rgba16f",
                    "scene=cornell lights=1 size=640x360 path=deferred layout=oct32 hdr=rgba16f",
                    "scene=cornell lights=2 size=640x360 path=deferred layout=oct16 hdr=rgba16f",
                    "scene=cornell lights=2 size=640x360 path=deferred layout=oct32 hdr=rgba16f"));
}

TEST(Sweep, a_path_without_a_layout_is_one_cell_for_the_whole_layout_axis) {
    // 3 forward paths + 3 paths x 3 layouts.
    EXPECT_THAT(cell_names(R"([{"scene": "cornell", "path": "*", "layout": "*"}])"), SizeIs(12));
}

TEST(Sweep, a_path_without_light_lists_is_one_cell_for_the_whole_axis) {
    EXPECT_THAT(
        cell_names(R"([{"scene": "cornell", "lights": 4, "light_lists": "*",
                                "path": ["forward", "deferred", "forward_clustered", "deferred_tiled"]}])"),
        ElementsAre("scene=cornell lights=4 size=640x360 path=forward hdr=rgba16f",
                    "scene=cornell lights=4 size=640x360 path=deferred layout=oct32 hdr=rgba16f",
                    "scene=cornell lights=4 size=640x360 path=forward_clustered light_lists=cpu hdr=rgba16f",
                    "scene=cornell lights=4 size=640x360 path=forward_clustered light_lists=compute hdr=rgba16f",
                    "scene=cornell lights=4 size=640x360 path=deferred_tiled layout=oct32 light_lists=cpu "
                    "hdr=rgba16f",
                    "scene=cornell lights=4 size=640x360 path=deferred_tiled layout=oct32 light_lists=compute "
                    "hdr=rgba16f"));
    EXPECT_THAT(cell_names(R"([{"scene": "cornell", "lights": 4, "path": "forward_clustered"}])"),
                ElementsAre("scene=cornell lights=4 size=640x360 path=forward_clustered light_lists=auto hdr=rgba16f"));
}

TEST(Sweep, blocks_are_united_and_duplicates_dropped) {
    const auto names = cell_names(R"([{"scene": "cornell", "lights": [1, 2], "path": "forward"},
                                      {"scene": "cornell", "lights": [2, 4, 4], "path": "forward"}])");
    EXPECT_THAT(names, ElementsAre("scene=cornell lights=1 size=640x360 path=forward hdr=rgba16f",
                                   "scene=cornell lights=2 size=640x360 path=forward hdr=rgba16f",
                                   "scene=cornell lights=4 size=640x360 path=forward hdr=rgba16f"));
}

TEST(Sweep, skips_are_cells_of_their_own_and_the_usual_ones_are_not_named) {
    EXPECT_THAT(cell_names(R"([{"scene": "cornell", "lights": 4, "path": ["forward", "deferred"],
                                "skip": ["*", "none+sort"]}])"),
                ElementsAre("scene=cornell lights=4 size=640x360 path=forward hdr=rgba16f",
                            "scene=cornell lights=4 size=640x360 path=forward hdr=rgba16f skip=none",
                            "scene=cornell lights=4 size=640x360 path=forward hdr=rgba16f skip=none+sort",
                            "scene=cornell lights=4 size=640x360 path=deferred layout=oct32 hdr=rgba16f",
                            "scene=cornell lights=4 size=640x360 path=deferred layout=oct32 hdr=rgba16f skip=none",
                            "scene=cornell lights=4 size=640x360 path=deferred layout=oct32 hdr=rgba16f "
                            "skip=none+sort"));
    EXPECT_THAT(cell_names(R"([{"scene": "cornell", "lights": 4, "path": "forward", "skip": "none+*"}])",
                           {{"skip", {"all-sort-frustum", "all-frustum-sort"}}}),
                ElementsAre("scene=cornell lights=4 size=640x360 path=forward hdr=rgba16f skip=all-frustum-sort"));
}

TEST(Sweep, an_override_replaces_its_axis_in_every_block) {
    const auto names = cell_names(R"([{"scene": "cornell", "lights": [1, 2], "path": "forward"},
                                      {"scene": "atrium", "lights": 64, "path": "forward"}])",
                                  {{"lights", {"8"}}, {"scene", {"materials"}}});
    EXPECT_THAT(names, ElementsAre("scene=materials lights=8 size=640x360 path=forward hdr=rgba16f"));
}

TEST(Sweep, options_are_read_and_may_be_missing) {
    const auto full = parse_sweep(
        R"({"summary": "s", "blocks": [{"scene": "atrium"}], "time_budget_s": 9.5, "target_ci": 0.05, "max_frame_s": 1.5,
            "maps": true})",
        "a.json", test_catalog());
    EXPECT_EQ(full.summary, "s");
    EXPECT_EQ(full.time_budget_s, 9.5);
    EXPECT_EQ(full.target_ci, 0.05);
    EXPECT_EQ(full.max_frame_s, 1.5);
    EXPECT_TRUE(full.maps);
    const auto bare = parse_sweep(R"({"summary": "s", "blocks": [{"scene": "atrium"}]})", "a.json", test_catalog());
    EXPECT_EQ(bare.time_budget_s, std::nullopt);
    EXPECT_EQ(bare.target_ci, std::nullopt);
    EXPECT_EQ(bare.max_frame_s, std::nullopt);
    EXPECT_FALSE(bare.maps);
}

TEST(Sweep, a_bad_file_is_refused_with_the_place) {
    EXPECT_THAT(input_error([] { cell_names(R"([{"scene": "cornell", "ligths": 1}])"); }),
                AllOf(StartsWith("sweep.json:/blocks/0: "), HasSubstr("did you mean 'lights'")));
    EXPECT_THAT(input_error([] { cell_names(R"([{"scene": "cornell"}, {"scene": "cornell", "path": "fast"}])"); }),
                StartsWith("sweep.json:/blocks/1/path: path=fast: "));
    EXPECT_THAT(input_error([] { cell_names(R"([{"lights": 1}])"); }),
                AllOf(StartsWith("sweep.json:/blocks/0: scene: "), HasSubstr("no value")));
    EXPECT_THAT(input_error([] { cell_names("[]"); }), HasSubstr("no block"));
    EXPECT_THAT(input_error([] {
                    parse_sweep(R"({"summary": "s", "blocks": [{}], "budget": 1})", "sweep.json", test_catalog());
                }),
                HasSubstr("unknown key 'budget'"));
    EXPECT_THROW(parse_sweep(R"({"summary": "s", "blocks": [{}], "time_budget_s": -1})", "a", test_catalog()),
                 InputError);
    EXPECT_THAT(input_error([] {
                    parse_sweep(R"({"summary": "s", "blocks": [{"scene": "atrium"}], "max_frame_s": 0})", "a",
                                test_catalog());
                }),
                StartsWith("a:/max_frame_s: "));
    EXPECT_THAT(input_error([] {
                    parse_sweep(R"({"summary": "s", "blocks": [{"scene": "atrium"}], "maps": 1})", "a", test_catalog());
                }),
                StartsWith("a:/maps: "));
    EXPECT_THROW(load_sweep("no_such_sweep", test_catalog()), InputError);
}

// A few lines may ask for more cells than memory holds.
TEST(Sweep, too_many_cells_are_refused) {
    std::string sizes;
    for (int i = 1; i <= 400; ++i) sizes += (i > 1 ? ",1x" : "1x") + std::to_string(i);
    const Sweep sweep = parse_sweep(R"({"summary": "s", "blocks": [{"scene": "atrium", "size": ")" + sizes +
                                        R"(", "lights": "pow2:0:20", "skip": "all-*"}]})",
                                    "a", test_catalog());
    EXPECT_THAT(input_error([&] { sweep_cells(sweep, {}, test_catalog()); }), StartsWith("a:/blocks/0: "));
}

TEST(Sweep, shipped_sweeps_load_and_have_cells_of_known_names) {
    auto paths = test_catalog().paths;
    paths.push_back({"forward_multipass"});
    paths.push_back({"deferred_clustered", true, true});
    const auto catalog = shipped_catalog(paths);
    const auto keys = resource_keys("bench/sweeps", ".json");
    ASSERT_THAT(keys, ::testing::IsSupersetOf({"default", "layouts", "paths", "smoke"}));
    for (const auto& key : keys) {
        const auto sweep = load_sweep(key, catalog);
        EXPECT_FALSE(sweep.summary.empty()) << key;
        EXPECT_FALSE(sweep_cells(sweep, {}, catalog).empty()) << key;
    }
}

TEST(Sweep, smoke_meets_every_scene_path_layout_and_hdr_format) {
    const auto catalog = shipped_catalog(test_catalog().paths);
    std::set<std::string> met;
    for (const auto& cell : sweep_cells(load_sweep("smoke", catalog), {}, catalog)) {
        met.insert({cell.scene, cell.path, cell.layout, cell.light_lists, cell.hdr});
        EXPECT_LE(cell.width * cell.height, 64 * 64);
    }
    for (const auto& names : {catalog.scenes, catalog.layouts, kHdrFormats, {"cpu", "compute"}}) {
        for (const auto& name : names) EXPECT_TRUE(met.contains(name)) << name;
    }
    for (const auto& path : catalog.paths) EXPECT_TRUE(met.contains(path.key)) << path.key;
}

}  // namespace
}  // namespace lightsweep
