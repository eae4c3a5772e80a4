// Scene files: what a small one becomes, and that every mistake is answered with its file and place.
#include "renderer/scene/scene.h"

#include "renderer/base/file.h"
#include "renderer/base/resources.h"
#include "tests/unit/scene/scene_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lightsweep {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

json small_scene() {
    return json::parse(R"({
        "summary": "a ball",
        "materials": {"red": {"model": "blinn_phong", "base_color": [1, 0, 0], "specular": [0.5, 0.5, 0.5]},
                      "steel": {"roughness": 0.3, "metallic": 1}},
        "shapes": {"ball": {"sphere": {"radius": 2, "segments": 8, "rings": 4}}},
        "instances": [{"shape": "ball", "material": "red", "translate": [1, 2, 3]}],
        "camera": {"eye": [0, 0, 9], "target": [0, 0, 0]},
        "lights": {"fixed": [{"kind": "spot", "color": [1, 2, 3], "position": [0, 5, 0], "direction": [0, -2, 0], "radius": 9}],
                   "generator": {"placement": "random", "bounds": {"low": [0, 0, 0], "high": [1, 1, 1]}, "radius": 2, "intensity": 3},
                   "default_count": 4}
    })");
}

class SceneJson : public testing::Test {
  protected:
    Scene load(const json& scene) { return load_scene(folder_.write("small.json", scene.dump())); }
    std::string error(const json& scene) {
        return input_error([&] { load(scene); });
    }
    // The small scene with the value at `pointer` replaced or added.
    static json with(const char* pointer, const json& value) {
        json scene = small_scene();
        scene[json::json_pointer(pointer)] = value;
        return scene;
    }

    TempFolder folder_;
};

TEST_F(SceneJson, ReadsASmallScene) {
    const Scene scene = load(small_scene());
    EXPECT_EQ(scene.key, "small");
    EXPECT_EQ(scene.summary, "a ball");
    ASSERT_EQ(scene.materials.size(), 1U) << "materials that nothing uses are left out";
    EXPECT_EQ(scene.materials[0].model, ShadingModel::blinn_phong);
    EXPECT_EQ(scene.materials[0].base_color, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.materials[0].specular, glm::vec3(0.5F));
    EXPECT_EQ(scene.triangle_count(), 2U * 8U * 4U - 2U * 8U) << "the poles have one triangle per segment";
    const Bounds bounds = scene.world_bounds();
    EXPECT_NEAR(glm::length(bounds.low - glm::dvec3(-1, 0, 1)), 0.0, 1e-6);
    EXPECT_NEAR(glm::length(bounds.high - glm::dvec3(3, 4, 5)), 0.0, 1e-6);
    ASSERT_EQ(scene.lights.fixed.size(), 1U);
    EXPECT_EQ(scene.lights.fixed[0].direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene.lights.generator->radius, 2.0);
    EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 0));
}

TEST_F(SceneJson, HashFollowsWhatIsDrawnAndNotTheSummary) {
    const std::string hash = load(small_scene()).content_hash;
    EXPECT_EQ(load(with("/summary", "another")).content_hash, hash);
    for (const auto& [pointer, value] : std::vector<std::pair<const char*, json>>{
             {"/camera/eye", {0, 0, 8}},
             {"/materials/red/roughness", 0.5},
             {"/materials/red/textures", {{"base_color", {{"checker", {{"colors", {{0, 0, 0}, {1, 1, 1}}}}}}}}},
             {"/shapes/ball/sphere/segments", 9},
             {"/instances/0/translate", {1, 2, 4}},
             {"/lights/fixed/0/color", {1, 2, 4}},
             {"/lights/generator/seed", 2},
             {"/ambient", {0, 0, 1}}}) {
        EXPECT_NE(load(with(pointer, value)).content_hash, hash) << pointer;
    }
}

TEST_F(SceneJson, RotatesAboutXThenYThenZ) {
    // x: y -> z; y: z -> x; z: x -> y. So the y axis goes z, x, y and comes home.
    const Scene scene = load(with("/instances/0/rotate_deg", {90, 90, 90}));
    const glm::dvec3 y(scene.instances[0].transform * glm::dvec4(0, 1, 0, 0));
    EXPECT_NEAR(glm::length(y - glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    const Scene about_x = load(with("/instances/0/rotate_deg", {90, 0, 0}));
    const glm::dvec3 z(about_x.instances[0].transform * glm::dvec4(0, 1, 0, 0));
    EXPECT_NEAR(glm::length(z - glm::dvec3(0, 0, 1)), 0.0, 1e-12);
}

TEST_F(SceneJson, GridRunsAlongXFirstAndIsCentred) {
    const Scene scene = load(with("/instances/0/grid", {{"count", {2, 1, 2}}, {"spacing", {4, 9, 6}}}));
    std::vector<glm::dvec3> positions;
    for (const Instance& instance : scene.instances) positions.emplace_back(instance.transform[3]);
    EXPECT_THAT(positions, testing::ElementsAre(glm::dvec3(-1, 2, 0), glm::dvec3(3, 2, 0), glm::dvec3(-1, 2, 6),
                                                glm::dvec3(3, 2, 6)));
    EXPECT_EQ(scene.meshes.size(), 1U);
}

TEST_F(SceneJson, TurnsAreSeededRotationsAboutY) {
    const auto load_turned = [&](int seed, int count) {
        return load(
            with("/instances/0/grid",
                 {{"count", {count, 1, 1}}, {"spacing", {1, 1, 1}}, {"origin", {0, 0, 0}}, {"turn_seed", seed}}));
    };
    const Scene a = load_turned(1, 5);
    EXPECT_EQ(a.content_hash, load_turned(1, 5).content_hash);
    EXPECT_NE(a.content_hash, load_turned(2, 5).content_hash);
    EXPECT_EQ(a.instances[2].transform, load_turned(1, 3).instances[2].transform);
    for (const Instance& instance : a.instances) {
        EXPECT_EQ(glm::dvec3(instance.transform[1]), glm::dvec3(0, 1, 0));
        EXPECT_NEAR(glm::determinant(instance.transform), 1.0, 1e-12);
    }
    EXPECT_NE(glm::dvec3(a.instances[0].transform[0]), glm::dvec3(a.instances[1].transform[0]));
}

TEST_F(SceneJson, FitHeightStandsAShapeOnItsBase) {
    const Bounds bounds = load(with("/instances/0/fit_height", 10)).world_bounds();
    EXPECT_NEAR(glm::length(bounds.low - glm::dvec3(-4, 2, -2)), 0.0, 1e-5);
    EXPECT_NEAR(glm::length(bounds.high - glm::dvec3(6, 12, 8)), 0.0, 1e-5);
}

TEST_F(SceneJson, TexturesAreShared) {
    json scene = small_scene();
    const json checker = {{"checker", {{"size", 16}, {"colors", {{0, 0, 0}, {1, 1, 1}}}}}};
    scene["materials"]["red"]["textures"] = {{"base_color", checker}, {"emissive", checker}};
    scene["materials"]["steel"]["textures"] = {{"base_color", checker}, {"metallic_roughness", checker}};
    EXPECT_EQ(load(scene).textures.size(), 2U) << "one as colour, one as data";
}

// 2 x 1 PNG: red, green. Assembled with Python's zlib from the PNG specification.
constexpr unsigned char kPng[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x7b, 0x40, 0xe8, 0xdd, 0x00, 0x00, 0x00,
    0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xc0, 0xf0, 0x9f, 0x01, 0x00, 0x07, 0xff,
    0x01, 0xff, 0x01, 0x7f, 0x89, 0xa7, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

TEST_F(SceneJson, ReadsImagesBesideTheSceneFile) {
    folder_.write("map.png", {reinterpret_cast<const char*>(kPng), sizeof kPng});
    const Scene scene = load(with("/materials/red/textures", {{"base_color", "map.png"}}));
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].width, 2);
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_THAT(scene.textures[0].rgba, testing::ElementsAre(255, 0, 0, 255, 0, 255, 0, 255));
}

struct Mistake {
    const char* pointer;
    const char* value;
    std::vector<const char*> message;
};

class SceneMistake : public SceneJson, public testing::WithParamInterface<Mistake> {};

TEST_P(SceneMistake, IsAnsweredWithFileAndPlace) {
    const auto& [pointer, value, message] = GetParam();
    const std::string line = error(with(pointer, json::parse(value)));
    EXPECT_THAT(line, HasSubstr("small.json:/"));
    for (const char* part : message) EXPECT_THAT(line, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneMistake,
    testing::Values(
        Mistake{"/camra", "1", {"unknown key 'camra'", "did you mean 'camera'?"}},
        Mistake{"/materials/red/model", R"("gxx")", {":/materials/red/model", "did you mean 'ggx'?"}},
        Mistake{"/materials/red/metallic", "1", {":/materials/red", "unknown key 'metallic'"}},
        Mistake{"/materials/red/roughness", "1.5", {":/materials/red/roughness", "from 0 to 1"}},
        Mistake{"/materials/red/base_color", "[1, 0]", {":/materials/red/base_color", "3 numbers"}},
        Mistake{"/materials/red/base_color/1", "null", {":/materials/red/base_color/1", "null"}},
        Mistake{"/materials/red/specular", R"("bright")", {":/materials/red/specular", "luminance"}},
        Mistake{"/materials/red/textures",
                R"({"base_color": "none.png"})",
                {":/materials/red/textures/base_color", "there is no file", "none.png"}},
        Mistake{"/materials/red/textures",
                R"({"normal": {"checker": {}}})",
                {":/materials/red/textures/normal", "unknown texture 'checker'", "bumps"}},
        Mistake{"/materials/red/textures",
                R"({"base_color": {"checker": {"squares": 3, "colors": [[0,0,0],[1,1,1]]}}})",
                {"/base_color/checker/squares", "even"}},
        Mistake{"/shapes/ball", R"({"spere": {}})", {":/shapes/ball", "did you mean 'sphere'?"}},
        Mistake{"/shapes/ball", R"({"sphere": {}, "box": {}})", {":/shapes/ball", "one shape was expected, not 2"}},
        Mistake{"/shapes/ball/sphere/radius", "-1", {":/shapes/ball/sphere/radius", "-1"}},
        Mistake{"/shapes/ball/sphere/segments", "2.5", {":/shapes/ball/sphere/segments", "whole number"}},
        Mistake{"/shapes/ball", R"({"arch": {"span": 4, "width": 4}})", {":/shapes/ball/arch", "less than 'width'"}},
        Mistake{"/shapes/ball", R"({"torus": {"tube": 4}})", {":/shapes/ball/torus", "'tube'"}},
        Mistake{"/shapes/ball", R"({"column": {"radius": 4}})", {":/shapes/ball/column", "'height'"}},
        Mistake{"/instances", "[]", {":/instances", "at least one"}},
        Mistake{"/instances/0/shape", R"("bell")", {":/instances/0/shape", "did you mean 'ball'?"}},
        Mistake{"/instances/0/material", R"("rod")", {":/instances/0/material", "did you mean 'red'?"}},
        Mistake{"/instances/0/scale", "0", {":/instances/0/scale", "flatten"}},
        Mistake{"/instances/0",
                R"({"shape": "ball", "material": "red", "scale": 2, "fit_height": 2})",
                {":/instances/0/fit_height", "'scale'"}},
        Mistake{"/instances/0/grid",
                R"({"count": [1000, 1000, 2], "spacing": [1, 1, 1]})",
                {":/instances/0/grid/count", "1000000"}},
        Mistake{
            "/instances/0/grid", R"({"count": [0, 1, 1], "spacing": [1, 1, 1]})", {":/instances/0/grid/count/0", "1"}},
        Mistake{
            "/instances/0/grid",
            R"({"count": [2, 1, 1], "spacing": [1, 1, 1], "vary": {"metallic": {"axis": "x", "from": 0, "to": 1}}})",
            {":/instances/0/grid/vary", "'red' has no such parameter"}},
        Mistake{"/instances/0", R"({"gltf": "none.gltf"})", {":/instances/0/gltf", "there is no file", "none.gltf"}},
        Mistake{"/camera/far", "0.05", {":/camera", "'far' must be more than 'near'"}},
        Mistake{"/camera/target", "[0, 0, 9]", {":/camera", "same point"}},
        Mistake{"/camera/up", "[0, 0, 1]", {":/camera", "'up' is along the view"}},
        Mistake{"/camera/fov_y_deg", "180", {":/camera/fov_y_deg", "from 1 to 170"}},
        Mistake{"/lights/fixed/0/kind", R"("sun")", {":/lights/fixed/0/kind", "directional"}},
        Mistake{"/lights/fixed/0/direction", "[0, 0, 0]", {":/lights/fixed/0/direction", "no direction"}},
        Mistake{"/lights/fixed/0/color/0", "-1", {":/lights/fixed/0/color/0", "-1"}},
        Mistake{"/lights/fixed/0/inner_deg", "60", {":/lights/fixed/0", "'inner_deg' must be less"}},
        Mistake{"/lights/generator/bounds/low", "[2, 0, 0]", {":/lights/generator/bounds", "'low'"}},
        Mistake{"/lights/generator/placement", R"("surface")", {":/lights/generator", "unknown key 'bounds'"}},
        Mistake{"/lights/generator/radius", "0", {":/lights/generator/radius"}},
        Mistake{"/lights/default_count", "-4", {":/lights/default_count", "-4"}},
        Mistake{"/lights/default_overlap", R"("8")", {":/lights/default_overlap"}},
        Mistake{"/ambient", "[0, -1, 0]", {":/ambient/1", "-1"}}));

TEST_F(SceneJson, LightsWithoutGeneratorBoundTheCount) {
    json scene = small_scene();
    scene["lights"].erase("generator");
    EXPECT_THAT(error(scene), AllOf(HasSubstr("/lights/default_count"), HasSubstr("from 0 to 1")));
}

TEST_F(SceneJson, MissingKeysAreNamed) {
    for (const char* key : {"summary", "camera", "lights", "instances"}) {
        json scene = small_scene();
        scene.erase(key);
        EXPECT_THAT(error(scene), HasSubstr(std::string("'") + key + "' is missing"));
    }
}

TEST_F(SceneJson, TextThatIsNoJsonIsAnsweredWithItsLine) {
    const std::string path = folder_.write("small.json", "{\n  \"summary\": NaN\n}");
    EXPECT_THAT(input_error([&] { load_scene(path); }), HasSubstr("small.json:2:"));
}

TEST_F(SceneJson, NamesThatNoFileCanHaveAreRefused) {
    const std::string too_long(5000, 'x');
    EXPECT_THAT(error(with("/materials/red/textures", {{"base_color", too_long}})), HasSubstr("there is no file"));
    EXPECT_THAT(error(with("/instances/0", {{"gltf", too_long}})), HasSubstr("there is no file"));
    EXPECT_THAT(input_error([&] { load_scene("./" + too_long); }), HasSubstr("no such file"));
}

TEST_F(SceneJson, AMessageIsOneLineWhateverAKeyHolds) {
    EXPECT_THAT(error(with("/inst\nances", 1)), HasSubstr("unknown key 'inst?ances'"));
    EXPECT_THAT(error(with("/materials/a\nb", {{"roughness", 2}})), HasSubstr("/materials/a?b/roughness"));
}

TEST_F(SceneJson, InstancesAreBoundedOverAllGrids) {
    const json grid = {
        {"shape", "ball"}, {"material", "red"}, {"grid", {{"count", {1000, 600, 1}}, {"spacing", {1, 1, 1}}}}};
    EXPECT_THAT(error(with("/instances", {grid, grid})),
                AllOf(HasSubstr("/instances/1"), HasSubstr("more than 1000000 instances")));
}

// Where a value is copied or printed level by level, the stack would end.
TEST_F(SceneJson, DeepNestingIsRefused) {
    const std::string deep(100'000, '[');
    EXPECT_THAT(
        input_error([&] { load_scene(folder_.write("deep.json", "{\"summary\": \"[[[\\\"[[[\", \"a\":\n" + deep)); }),
        AllOf(HasSubstr("deep.json:2:100"), HasSubstr("nests deeper than 100")));
}

TEST_F(SceneJson, TheReadmesExampleLoads) {
    const std::string readme = read_file(resource("scenes/README.md"));
    const size_t begin = readme.find("```json\n") + 8;
    const Scene scene = load(json::parse(readme.substr(begin, readme.find("```", begin) - begin)));
    EXPECT_EQ(scene.instances.size(), 10U);
}

TEST_F(SceneJson, OtherFilesAreRefused) {
    EXPECT_THAT(input_error([&] { load_scene("no/such/scene.json"); }), HasSubstr("no/such/scene.json"));
    const std::string path = folder_.write("model.obj", "v 0 0 0");
    EXPECT_THAT(input_error([&] { load_scene(path); }), AllOf(HasSubstr("model.obj"), HasSubstr(".gltf")));
}

TEST_F(SceneJson, DamagedImagesAreRefused) {
    folder_.write("map.png", {reinterpret_cast<const char*>(kPng), sizeof kPng / 2});
    EXPECT_THAT(error(with("/materials/red/textures", {{"base_color", "map.png"}})),
                AllOf(HasSubstr("map.png"), HasSubstr("cannot be decoded")));
}

}  // namespace
}  // namespace lightsweep
