#include "bench/plan/axes.h"

#include "test_catalog.h"

#include "renderer/base/json_reader.h"
#include "renderer/base/skips.h"

#include <gmock/gmock.h>

#include <fstream>
#include <tuple>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> values(const std::string& axis, const std::string& text) {
    return parse_axis_values(find_cell_field(axis), text, test_catalog());
}

std::vector<std::string> json_values(const std::string& axis, const std::string& json) {
    return parse_axis_values(find_cell_field(axis), JsonReader::from_text(json, "sweep.json"), test_catalog());
}

TEST(Axes, lists_ranges_and_stars_stand_for_their_values) {
    EXPECT_THAT(values("lights", "1,16,256"), ElementsAre("1", "16", "256"));
    EXPECT_THAT(values("lights", "pow2:0:3"), ElementsAre("1", "2", "4", "8"));
    EXPECT_THAT(values("lights", "0,pow2:19:20,default"), ElementsAre("0", "524288", "1048576", "default"));
    EXPECT_THAT(values("size", "640x360,1280x720"), ElementsAre("640x360", "1280x720"));
    EXPECT_THAT(values("overlap", "fixed,scene,2.5"), ElementsAre("fixed", "scene", "2.5"));
    EXPECT_THAT(values("path", "*"), ElementsAre("forward", "forward_prepass", "forward_clustered", "deferred",
                                                 "deferred_volumes", "deferred_tiled"));
    EXPECT_THAT(values("layout", "*"), ElementsAre("float32", "oct16", "oct32"));
    EXPECT_THAT(values("scene", "*"), ElementsAre("atrium", "cornell", "materials"));
    EXPECT_THAT(values("light_lists", "*"), ElementsAre("cpu", "compute"));
    EXPECT_THAT(values("light_lists", "auto,cpu"), ElementsAre("auto", "cpu"));
    EXPECT_THAT(values("hdr", "*"), ElementsAre("rgba16f", "rgba32f", "r11g11b10f"));
    EXPECT_THAT(values("guards", "*"), ElementsAre("on", "off"));
    EXPECT_THAT(values("sums", "compensated,plain"), ElementsAre("compensated", "plain"));
    EXPECT_THAT(values("sums", "*"), ElementsAre("plain", "compensated"));
    EXPECT_THAT(default_axis_values(find_cell_field("guards"), test_catalog()), ElementsAre("on"));
    EXPECT_THAT(default_axis_values(find_cell_field("sums"), test_catalog()), ElementsAre("plain"));
}

TEST(Axes, skips_are_sets_and_stars_turn_them_one_at_a_time) {
    EXPECT_THAT(values("skip", "all,none,all-frustum,none+light_lists,auto"),
                ElementsAre("all", "none", "all-frustum", "none+light_lists", "auto"));
    EXPECT_THAT(values("skip", "*"), ElementsAre("all", "none"));
    for (const auto& [star, base, sign] : {std::tuple("all-*", "all", "-"), std::tuple("none+*", "none", "+")}) {
        const auto sets = values("skip", star);
        ASSERT_EQ(sets.size(), kSkipCount);
        for (size_t i = 0; i < sets.size(); ++i) {
            EXPECT_EQ(sets[i], base + std::string(sign) + std::string(skip_infos()[i].key));
        }
    }
    EXPECT_THAT(default_axis_values(find_cell_field("skip"), test_catalog()), ElementsAre("all"));
    EXPECT_EQ(json_values("skip", R"(["all", "none+*"])").size(), 1 + kSkipCount);
    for (const std::string bad : {"all+*", "none-*", "all-*-sort", "", "All"}) {
        EXPECT_THROW(values("skip", bad), InputError) << bad;
    }
    EXPECT_THAT(input_error([] { json_values("skip", R"(["all-clear"])"); }),
                AllOf(StartsWith("sweep.json:/: "), HasSubstr("did you mean 'clears'")));
}

TEST(Axes, a_users_own_file_is_a_value_when_it_exists) {
    const std::string file = ::testing::TempDir() + "/own_layout.json";
    std::ofstream(file) << "{}";
    EXPECT_THAT(values("layout", "oct16," + file), ElementsAre("oct16", file));
    EXPECT_THAT(input_error([] { values("scene", "no/such/yard.json"); }),
                AllOf(StartsWith("scene=no/such/yard.json: "), HasSubstr("no such file")));
}

TEST(Axes, json_gives_the_same_values_as_text) {
    EXPECT_EQ(json_values("lights", R"("pow2:0:3")"), values("lights", "pow2:0:3"));
    EXPECT_EQ(json_values("lights", "[1, 16, \"pow2:5:6\"]"), values("lights", "1,16,32,64"));
    EXPECT_EQ(json_values("lights", "4"), values("lights", "4"));
    EXPECT_EQ(json_values("overlap", "[\"fixed\", 2.5]"), values("overlap", "fixed,2.5"));
    EXPECT_EQ(json_values("path", "[\"forward\", \"deferred\"]"), values("path", "forward,deferred"));
}

TEST(Axes, the_limits_are_allowed_and_one_beyond_them_is_not) {
    EXPECT_THAT(values("lights", "0,1048576"), ElementsAre("0", "1048576"));
    EXPECT_THAT(values("size", "1x65536"), ElementsAre("1x65536"));
    for (const std::string bad :
         {"-1", "1048577", "1e3", "4.5", "", "1,,2", "99999999999999999999", "nan", "0x10", "*"}) {
        EXPECT_THROW(values("lights", bad), InputError) << bad;
    }
    for (const std::string bad :
         {"640", "640x", "x360", "0x360", "-640x360", "640x65537", "640x360x2", "640X360", " 1x1"}) {
        EXPECT_THROW(values("size", bad), InputError) << bad;
    }
    for (const std::string bad : {"0", "-1", "nan", "inf", "1e300", "none"}) {
        EXPECT_THROW(values("overlap", bad), InputError) << bad;
    }
    for (const std::string bad : {"pow2:", "pow2:1", "pow2:3:1", "pow2:0:21", "pow2:-1:3", "pow2:0:x", "pow2:0:1:2"}) {
        EXPECT_THROW(values("lights", bad), InputError) << bad;
    }
}

TEST(Axes, an_error_names_axis_value_nearest_name_and_what_is_allowed) {
    EXPECT_THAT(input_error([] { values("lights", "16,-3"); }),
                AllOf(StartsWith("lights=-3: "), HasSubstr("from 0 to 1048576")));
    EXPECT_THAT(
        input_error([] { values("path", "defered"); }),
        AllOf(StartsWith("path=defered: "), HasSubstr("did you mean 'deferred'"), HasSubstr("forward_prepass")));
    EXPECT_THAT(input_error([] { values("scene", "no_such_scene"); }),
                AllOf(StartsWith("scene=no_such_scene: "), HasSubstr("known: "), HasSubstr("path of a file")));
    EXPECT_THAT(input_error([] { values("hdr", "rgba8"); }), AllOf(StartsWith("hdr=rgba8: "), HasSubstr("rgba32f")));
    EXPECT_THAT(input_error([] { values("light_lists", "gpu"); }),
                AllOf(StartsWith("light_lists=gpu: "), HasSubstr("auto, cpu or compute")));
    EXPECT_THAT(input_error([] { values("guards", "yes"); }),
                AllOf(StartsWith("guards=yes: "), HasSubstr("on or off")));
    EXPECT_THAT(input_error([] { values("sums", "kahan"); }),
                AllOf(StartsWith("sums=kahan: "), HasSubstr("plain or compensated")));
    EXPECT_THAT(input_error([] { values("layout", ""); }), AllOf(StartsWith("layout: "), HasSubstr("a layout's key")));
}

TEST(Axes, an_error_in_json_names_the_place) {
    EXPECT_THAT(input_error([] { json_values("lights", "[1, true]"); }), StartsWith("sweep.json:/1: "));
    EXPECT_THAT(input_error([] { json_values("lights", "[1, -2]"); }),
                AllOf(StartsWith("sweep.json:/: "), HasSubstr("lights=-2")));
    EXPECT_THAT(input_error([] { json_values("lights", "null"); }), StartsWith("sweep.json:/: "));
    EXPECT_THAT(input_error([] { json_values("lights", "[]"); }), HasSubstr("no value"));
}

TEST(Axes, arguments_name_each_axis_once) {
    const auto parsed = parse_axis_arguments({"lights=1,2", "path=deferred"}, test_catalog());
    EXPECT_THAT(parsed.at("lights"), ElementsAre("1", "2"));
    EXPECT_THAT(parsed.at("path"), ElementsAre("deferred"));
    EXPECT_THAT(input_error([] { parse_axis_arguments({"lights"}, test_catalog()); }), HasSubstr("axis=values"));
    EXPECT_THAT(input_error([] { parse_axis_arguments({"ligths=1"}, test_catalog()); }),
                HasSubstr("did you mean 'lights'"));
    EXPECT_THAT(input_error([] {
                    parse_axis_arguments({"lights=1", "lights=2"}, test_catalog());
                }),
                HasSubstr("twice"));
}

}  // namespace
}  // namespace lightsweep
