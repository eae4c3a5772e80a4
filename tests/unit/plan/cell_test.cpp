#include "bench/plan/cell.h"

#include "test_catalog.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const CellParams kDeferred{.scene = "atrium",
                           .lights = 64,
                           .width = 640,
                           .height = 360,
                           .overlap = std::nullopt,
                           .path = "deferred",
                           .layout = "oct16",
                           .light_lists = "",
                           .hdr = "rgba16f"};

TEST(Cell, name_is_one_line_of_the_fields_in_order) {
    EXPECT_EQ(kDeferred.name(), "scene=atrium lights=64 size=640x360 path=deferred layout=oct16 hdr=rgba16f");
}

TEST(Cell, name_leaves_out_the_layout_of_a_path_without_one_and_the_scenes_own_overlap) {
    CellParams cell = kDeferred;
    cell.layout.clear();
    cell.path = "forward";
    EXPECT_EQ(cell.name(), "scene=atrium lights=64 size=640x360 path=forward hdr=rgba16f");
    cell.overlap = 0.0;
    EXPECT_EQ(cell.name(), "scene=atrium lights=64 size=640x360 overlap=fixed path=forward hdr=rgba16f");
    cell.overlap = 2.5;
    cell.lights.reset();
    EXPECT_EQ(cell.name(), "scene=atrium lights=default size=640x360 overlap=2.5 path=forward hdr=rgba16f");
}

TEST(Cell, name_says_who_builds_the_light_lists_of_a_path_with_some) {
    CellParams cell = kDeferred;
    cell.path = "deferred_tiled";
    cell.light_lists = "auto";
    EXPECT_EQ(cell.name(),
              "scene=atrium lights=64 size=640x360 path=deferred_tiled layout=oct16 light_lists=auto hdr=rgba16f");
    EXPECT_EQ(cell.group(), kDeferred.group());
    const std::string automatic = cell.id();
    cell.light_lists = "cpu";
    EXPECT_NE(cell.id(), automatic) << "what was asked, not what it came to";
}

TEST(Cell, name_says_what_is_skipped_unless_it_is_all) {
    CellParams cell = kDeferred;
    EXPECT_EQ(cell.skip, "all");
    for (const auto& [written, canonical] :
         std::vector<std::pair<std::string, std::string>>{{"none", "none"},
                                                          {"auto", "auto"},
                                                          {"all-sort-frustum", "all-frustum-sort"},
                                                          {"none+sort+light_lists", "none+light_lists+sort"},
                                                          {"all-frustum+frustum-sort", "all-sort"}}) {
        set_cell_field(cell, find_cell_field("skip"), written);
        EXPECT_EQ(cell.name(), kDeferred.name() + " skip=" + canonical);
        EXPECT_EQ(parse_cell(cell.name()), cell);
        EXPECT_EQ(cell.group(), kDeferred.group());
    }
    set_cell_field(cell, find_cell_field("skip"), "all-sort+sort");
    EXPECT_EQ(cell, kDeferred) << "names of before mean what they meant";
    EXPECT_EQ(parse_cell(kDeferred.name() + " skip=all").id(), kDeferred.id());
}

TEST(Cell, name_says_guards_and_sums_unless_they_are_the_defaults) {
    EXPECT_EQ(parse_cell(kDeferred.name() + " guards=on sums=plain"), kDeferred)
        << "names of before mean what they did";
    EXPECT_THAT(switched(kDeferred), IsEmpty());
    const CellParams bare = parse_cell(kDeferred.name() + " sums=compensated guards=off");
    EXPECT_EQ(bare.name(), kDeferred.name() + " guards=off sums=compensated");
    EXPECT_EQ(parse_cell(bare.name()), bare);
    EXPECT_EQ(bare.group(), kDeferred.group()) << "the two are compared";
    EXPECT_THAT(switched(bare), ElementsAre("guards=off", "sums=compensated"));
    EXPECT_THAT(switched(parse_cell(kDeferred.name() + " skip=none")), ElementsAre("skip=none"));
}

TEST(Cell, a_set_that_is_none_is_refused_with_the_nearest_skip) {
    const auto refused = [](const std::string& value) {
        return input_error([&] { parse_cell(kDeferred.name() + " skip=" + value); });
    };
    EXPECT_THAT(refused("all-frustrum"), AllOf(HasSubstr("skip=all-frustrum: 'frustrum'"), HasSubstr("'frustum'"),
                                               HasSubstr("allowed: auto, or all or none"), HasSubstr("light_depth")));
    EXPECT_THAT(refused("non"), HasSubstr("did you mean 'none'"));
    EXPECT_THAT(refused("frustum"), HasSubstr("'frustum' is not allowed"));
    EXPECT_THAT(refused("all-"), HasSubstr("'' is not allowed"));
    EXPECT_THAT(refused("auto-sort"), HasSubstr("auto takes no keys"));
}

TEST(Cell, parsing_a_name_gives_the_cell_back) {
    for (const std::optional<int> lights :
         {std::optional<int>{}, std::optional<int>{0}, std::optional<int>{kMaxLights}}) {
        for (const std::optional<double> overlap : {std::optional<double>{}, std::optional<double>{0.0},
                                                    std::optional<double>{0.1}, std::optional<double>{8.0}}) {
            for (const std::string scene : {"atrium", "my models/a yard.json", "../x/lights.gltf"}) {
                for (const std::string layout : {"", "oct16", "my layouts/a b.json"}) {
                    for (const std::string light_lists : {"", "auto", "compute"}) {
                        const CellParams cell{.scene = scene,
                                              .lights = lights,
                                              .width = 1,
                                              .height = kMaxExtentPx,
                                              .overlap = overlap,
                                              .path = "deferred",
                                              .layout = layout,
                                              .light_lists = light_lists,
                                              .hdr = "r11g11b10f"};
                        EXPECT_EQ(parse_cell(cell.name()), cell) << cell.name();
                    }
                }
            }
        }
    }
}

TEST(Cell, id_is_the_hash_of_the_name_and_differs_with_every_field) {
    EXPECT_EQ(kDeferred.id().size(), 16U);
    EXPECT_EQ(kDeferred.id(), CellParams(kDeferred).id());
    for (const std::string changed :
         {"scene=cornell", "lights=65", "size=640x361", "overlap=fixed", "path=forward", "layout=oct32",
          "light_lists=cpu", "hdr=rgba32f", "skip=none", "skip=auto", "guards=off", "sums=compensated"}) {
        CellParams cell = kDeferred;
        const size_t equals = changed.find('=');
        set_cell_field(cell, find_cell_field(changed.substr(0, equals)), changed.substr(equals + 1));
        EXPECT_NE(cell.id(), kDeferred.id()) << changed;
    }
}

TEST(Cell, group_is_what_compared_cells_share) {
    CellParams other = kDeferred;
    other.path = "forward";
    other.layout.clear();
    other.hdr = "rgba32f";
    EXPECT_EQ(other.group(), kDeferred.group());
    EXPECT_EQ(other.group(), "scene=atrium lights=64 size=640x360");
    other.overlap = 4.0;
    EXPECT_EQ(other.group(), "scene=atrium lights=64 size=640x360 overlap=4");
}

TEST(Cell, text_that_is_no_cell_is_refused_with_what_is_wrong) {
    EXPECT_THAT(input_error([] { parse_cell("atrium"); }), HasSubstr("'atrium' is not key=value"));
    EXPECT_THAT(input_error([] { parse_cell("scene=a=b path=forward"); }), HasSubstr("two '='"));
    EXPECT_THAT(input_error([] { parse_cell("scene=atrium lights=4"); }), HasSubstr("missing"));
    EXPECT_THAT(input_error([] { parse_cell(""); }), HasSubstr("missing"));
    EXPECT_THAT(input_error([] { parse_cell("scene=atrium light=4 path=forward"); }),
                AllOf(HasSubstr("unknown axis 'light'"), HasSubstr("did you mean 'lights'")));
}

}  // namespace
}  // namespace lightsweep
