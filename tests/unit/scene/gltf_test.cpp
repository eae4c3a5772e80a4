// glTF files made here: what they become, and that no malformed one is read past its end or drawn silently wrong.
#include "renderer/scene/gltf.h"

#include "tests/unit/scene/scene_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace lightsweep {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A file with one buffer, to which accessors are appended.
struct Model {
    json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    std::string bin;

    template <typename T>
    int add(const char* type, int component_type, const std::vector<T>& values, bool normalized = false) {
        const int components = type == std::string("SCALAR") ? 1 : type[3] - '0';
        bin.resize((bin.size() + 3) / 4 * 4);
        auto& views = document["bufferViews"];
        auto& accessors = document["accessors"];
        views.push_back({{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", values.size() * sizeof(T)}});
        accessors.push_back({{"bufferView", views.size() - 1},
                             {"componentType", component_type},
                             {"count", values.size() / static_cast<size_t>(components)},
                             {"type", type},
                             {"normalized", normalized}});
        bin += bytes_of(values);
        return static_cast<int>(accessors.size()) - 1;
    }

    // Writes NAME.gltf and NAME.bin.
    std::string write(const TempFolder& folder) {
        bin.resize((bin.size() + 3) / 4 * 4);
        document["buffers"] = {{{"uri", "model.bin"}, {"byteLength", bin.size()}}};
        folder.write("model.bin", bin);
        return folder.write("model.gltf", document.dump());
    }

    std::string glb() {
        bin.resize((bin.size() + 3) / 4 * 4);
        document["buffers"] = {{{"byteLength", bin.size()}}};
        std::string text = document.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto size = [](size_t n) { return bytes_of(std::vector{static_cast<uint32_t>(n)}); };
        return "glTF" + size(2) + size(12 + 8 + text.size() + 8 + bin.size()) + size(text.size()) + "JSON" + text +
               size(bin.size()) + std::string("BIN\0", 4) + bin;
    }
};

constexpr int kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kFloat = 5126;

// One triangle facing +z, with normals and coordinates.
Model triangle() {
    Model model;
    const int positions = model.add<float>("VEC3", kFloat, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int normals = model.add<float>("VEC3", kFloat, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int uvs = model.add<float>("VEC2", kFloat, {0, 1, 1, 1, 0, 0});
    const int indices = model.add<uint16_t>("SCALAR", kUnsignedShort, {0, 1, 2});
    model.document["meshes"] = {{{"primitives",
                                  {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                                    {"indices", indices}}}}}};
    model.document["nodes"] = {{{"mesh", 0}}};
    return model;
}

// A 2 x 1 PNG, red and green, as a data URI.
constexpr const char* kPngUri =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4z8DA8J8BAAf/"
    "Af8Bf4mnAAAAAElFTkSuQmCC";

class Gltf : public testing::Test {
  protected:
    Scene load(Model model) { return load_scene(model.write(folder_)); }
    std::string error(Model model) {
        return input_error([&] { load(std::move(model)); });
    }
    // The triangle with the value at `pointer` replaced or added.
    static Model with(const char* pointer, const json& value) {
        Model model = triangle();
        model.document[json::json_pointer(pointer)] = value;
        return model;
    }

    TempFolder folder_;
};

TEST_F(Gltf, TriangleGetsTheDefaultMaterialTangentsCameraAndLights) {
    const Scene scene = load(triangle());
    EXPECT_EQ(scene.key, "model");
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_EQ(scene.triangle_count(), 1U);
    expect_sound_frames(scene.vertices, scene.indices);
    for (const Vertex& v : scene.vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, 1));
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].metallic, 1.0F) << "glTF's default";
    EXPECT_EQ(make_lights(scene, 64, {}).size(), 64U);
}

// In a square picture, and filling most of it.
TEST_F(Gltf, CameraSeesTheWholeModel) {
    const Scene scene = load(triangle());
    const Camera& camera = scene.camera;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    double widest = 0.0;
    for (const Vertex& v : scene.vertices) {
        const glm::dvec3 to = glm::dvec3(v.position) - camera.eye;
        const double depth = glm::dot(to, forward);
        EXPECT_GT(depth, camera.near_distance);
        EXPECT_LT(depth, camera.far_distance);
        for (const glm::dvec3& axis : {right, glm::cross(right, forward)}) {
            widest = std::max(widest, std::abs(glm::dot(to, axis)) / depth);
        }
    }
    EXPECT_LT(widest, std::tan(glm::radians(0.5 * camera.fov_y_deg)));
    EXPECT_GT(widest, std::tan(glm::radians(0.5 * camera.fov_y_deg)) * 0.8);
}

TEST_F(Gltf, BinaryFormAndDataUrisGiveTheSameScene) {
    const std::string expected = load(triangle()).content_hash;
    EXPECT_EQ(load_scene(folder_.write("model.glb", triangle().glb())).content_hash, expected);
    Model embedded = triangle();
    embedded.document["buffers"] = {
        {{"uri",
          "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"
          "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAAAAAAAAAAAABAAIAAAA="},
         {"byteLength", embedded.bin.size() + 2}}};
    EXPECT_EQ(load_scene(folder_.write("model.gltf", embedded.document.dump())).content_hash, expected);
}

// The spec's formulas by hand: unsigned bytes c / 255; signed shorts max(c / 32767, -1).
TEST_F(Gltf, NormalisedIntegersAreScaled) {
    Model model = triangle();
    const int positions = model.add<int16_t>("VEC3", kShort, {-32768, 0, 0, 32767, 0, 0, 0, 16384, 0}, true);
    const int uvs = model.add<uint8_t>("VEC2", kUnsignedByte, {0, 255, 255, 255, 51, 0}, true);
    // A VEC3 of shorts has 6 bytes; its view's stride must be a multiple of 4 in a strict file, but tight data is read.
    auto& attributes = model.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = positions;
    attributes["TEXCOORD_0"] = uvs;
    const Scene scene = load(model);
    EXPECT_EQ(scene.vertices[0].position, glm::vec3(-1, 0, 0));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(scene.vertices[2].position.y, 16384.0F / 32767.0F);
    EXPECT_EQ(scene.vertices[1].uv, glm::vec2(1, 1));
    EXPECT_FLOAT_EQ(scene.vertices[2].uv.x, 0.2F);
}

TEST_F(Gltf, PlainIntegersAreTakenAsTheyAre) {
    Model model = triangle();
    model.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    model.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int positions = model.add<uint16_t>("VEC3", kUnsignedShort, {0, 0, 0, 300, 0, 0, 0, 300, 0});
    model.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
    const Scene scene = load(model);
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(300, 0, 0));
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(Gltf, InterleavedDataIsRead) {
    Model model = triangle();
    // Position and coordinates side by side: 20 bytes per vertex.
    const int interleaved =
        model.add<float>("VEC3", kFloat, {0, 0, 0, 0.1F, 0.9F, 2, 0, 0, 0.8F, 0.9F, 0, 2, 0, 0.1F, 0.2F});
    auto& accessor = model.document["accessors"][static_cast<size_t>(interleaved)];
    auto& view = model.document["bufferViews"][accessor["bufferView"].get<size_t>()];
    view["byteStride"] = 20;
    accessor["count"] = 3;
    json uvs = accessor;
    uvs["type"] = "VEC2";
    uvs["byteOffset"] = 12;
    model.document["accessors"].push_back(uvs);
    auto& attributes = model.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = interleaved;
    attributes["TEXCOORD_0"] = model.document["accessors"].size() - 1;
    const Scene scene = load(model);
    EXPECT_EQ(scene.vertices[2].position, glm::vec3(0, 2, 0));
    EXPECT_EQ(scene.vertices[1].uv, glm::vec2(0.8F, 0.9F));
}

TEST_F(Gltf, MissingNormalsBecomeFlatOnes) {
    Model model = triangle();
    model.document["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const Scene scene = load(model);
    for (const Vertex& v : scene.vertices) EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    expect_sound_frames(scene.vertices, scene.indices);
}

TEST_F(Gltf, NormalsOfLengthZeroAreReplacedWithAWarning) {
    Model model = triangle();
    const int normals = model.add<float>("VEC3", kFloat, {0, 0, 1, 0, 0, 0, 0, 0, 1});
    model.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    const Scene scene = load(model);
    expect_sound_frames(scene.vertices, scene.indices);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("normals of length 0")));
}

TEST_F(Gltf, PrimitivesWithoutIndicesAndCoordinatesAreDrawn) {
    Model model = triangle();
    auto& primitive = model.document["meshes"][0]["primitives"][0];
    primitive.erase("indices");
    primitive["attributes"].erase("TEXCOORD_0");
    const Scene scene = load(model);
    EXPECT_EQ(scene.triangle_count(), 1U);
    expect_sound_frames(scene.vertices, scene.indices);
}

TEST_F(Gltf, NodesMultiplyDownTheHierarchy) {
    Model model = triangle();
    // Parent: moved by 10 along x, scaled by 2. Child: a quarter turn about z, moved by 1 along y. Grandchild: a
    // matrix.
    model.document["nodes"] = {{{"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}, {"children", {1}}},
                               {{"translation", {0, 1, 0}},
                                {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}},
                                {"children", {2}},
                                {"mesh", 0}},
                               {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}, {"mesh", 0}}};
    const Scene scene = load(model);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U);
    const auto at = [&](size_t instance) {
        return glm::dvec3(scene.instances[instance].transform * glm::dvec4(1, 0, 0, 1));
    };
    // (1, 0, 0) turns to (0, 1, 0), moves to (0, 2, 0), grows to (0, 4, 0), moves to (10, 4, 0).
    EXPECT_NEAR(glm::length(at(0) - glm::dvec3(10, 4, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(at(1) - glm::dvec3(10, 4, 10)), 0.0, 1e-12);
}

TEST_F(Gltf, MaterialsAndTexturesAreConverted) {
    Model model = with("/meshes/0/primitives/0/material", 0);
    model.document["images"] = {{{"uri", kPngUri}}};
    model.document["textures"] = {{{"source", 0}}};
    model.document["materials"] = {{{"name", "leaf"},
                                    {"pbrMetallicRoughness",
                                     {{"baseColorFactor", {0.1, 0.2, 0.3, 0.5}},
                                      {"metallicFactor", 0.25},
                                      {"roughnessFactor", 0.75},
                                      {"baseColorTexture", {{"index", 0}}},
                                      {"metallicRoughnessTexture", {{"index", 0}}}}},
                                    {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                                    {"emissiveFactor", {1, 0.5, 0}},
                                    {"alphaMode", "MASK"},
                                    {"alphaCutoff", 0.25},
                                    {"doubleSided", true}}};
    const Scene scene = load(model);
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_EQ(scene.materials.size(), 1U);
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.name, "leaf");
    EXPECT_EQ(m.model, ShadingModel::ggx);
    EXPECT_EQ(m.base_color, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(m.metallic, 0.25F);
    EXPECT_EQ(m.roughness, 0.75F);
    EXPECT_EQ(m.emissive, glm::vec3(1, 0.5F, 0));
    EXPECT_EQ(m.normal_scale, 0.5F);
    EXPECT_EQ(m.alpha_cutoff, 0.5F) << "0.5 a < 0.25 where a < 0.5";
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.emissive_texture, kNoTexture);
    ASSERT_EQ(scene.textures.size(), 2U) << "the image as colour, and once more as data for both others";
    EXPECT_TRUE(scene.textures[static_cast<size_t>(m.base_color_texture)].srgb);
    EXPECT_FALSE(scene.textures[static_cast<size_t>(m.normal_texture)].srgb);
    EXPECT_EQ(m.normal_texture, m.metallic_roughness_texture);
    EXPECT_THAT(scene.textures[0].rgba, ElementsAre(255, 0, 0, 255, 0, 255, 0, 255));
}

TEST_F(Gltf, WhatIsDrawnOtherwiseIsSaid) {
    Model model = with("/meshes/0/primitives/0/material", 0);
    model.document["materials"] = {{{"name", "glass"}, {"alphaMode", "BLEND"}}};
    model.document["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    json lines = model.document["meshes"][0]["primitives"][0];
    lines["mode"] = 1;
    model.document["meshes"][0]["primitives"].push_back(lines);
    const Scene scene = load(model);
    EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.0F);
    EXPECT_EQ(scene.triangle_count(), 1U);
    EXPECT_THAT(scene.warnings, testing::UnorderedElementsAre(
                                    "model.gltf: the blended material 'glass' is drawn as opaque",
                                    "model.gltf: the extension KHR_materials_pbrSpecularGlossiness is ignored",
                                    "model.gltf: points, lines, strips and fans are not drawn"));
}

TEST_F(Gltf, PlacedTwiceItIsStoredOnce) {
    triangle().write(folder_);
    const std::string scene_file = folder_.write("scene.json", R"({
        "summary": "two rows of one model", "camera": {"eye": [0, 0, 9], "target": [0, 0, 0]}, "lights": {"default_count": 0},
        "instances": [{"gltf": "model.gltf", "fit_height": 3, "grid": {"count": [4, 1, 1], "spacing": [2, 0, 0]}},
                      {"gltf": "./model.gltf", "translate": [0, 0, -5]}]})");
    const Scene scene = load_scene(scene_file);
    EXPECT_EQ(scene.instances.size(), 5U);
    EXPECT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.vertices.size(), 3U);
    const auto corner = [&](double x, double y) {
        return glm::dvec3(scene.instances[0].transform * glm::dvec4(x, y, 0, 1));
    };
    EXPECT_EQ(corner(0.5, 0), glm::dvec3(-3, 0, 0)) << "centred on its place";
    EXPECT_EQ(corner(0.5, 1), glm::dvec3(-3, 3, 0)) << "three tall";
}

TEST_F(Gltf, MistakesAreAnsweredWithFileAndPlace) {
    const auto expect = [&](const char* pointer, const json& value, const char* place, const char* what) {
        EXPECT_THAT(error(with(pointer, value)), AllOf(HasSubstr("model.gltf:"), HasSubstr(place), HasSubstr(what)))
            << pointer;
    };
    expect("/accessors/0/count", 4, "/accessors/0", "past the end of the buffer view");
    expect("/accessors/0/count", 1ULL << 62, "/accessors/0", "past the end of the buffer view");
    expect("/accessors/0/byteOffset", 1ULL << 63, "/accessors/0", "past the end of the buffer view");
    expect("/accessors/1/count", 2, "/attributes/NORMAL", "vertices were expected");
    expect("/accessors/0/bufferView", 9, "/accessors/0/bufferView", "9 is not an index of 'bufferViews'");
    expect("/accessors/0/type", "VEC2", "/accessors/0/type", "3 numbers per element");
    expect("/accessors/0/componentType", 5124, "/accessors/0/componentType", "5124");
    expect("/accessors/3/componentType", kFloat, "/accessors/3", "");
    expect("/accessors/0/sparse",
           {{"count", 1},
            {"indices", {{"bufferView", 0}, {"componentType", kUnsignedShort}}},
            {"values", {{"bufferView", 0}}}},
           "/accessors/0/sparse", "not supported");
    expect("/bufferViews/0/byteLength", 1000, "/bufferViews/0", "past the end of the buffer");
    expect("/bufferViews/0/byteOffset", 1ULL << 63, "/bufferViews/0", "past the end of the buffer");
    expect("/bufferViews/0/buffer", 3, "/bufferViews/0/buffer", "3 is not an index of 'buffers'");
    expect("/bufferViews/0/byteStride", 4, "/bufferViews/0/byteStride", "below one element");
    expect("/meshes/0/primitives/0/indices", 0, "/accessors/0/type", "1 numbers");
    expect("/meshes/0/primitives/0/attributes/POSITION", 77, "/attributes/POSITION",
           "77 is not an index of 'accessors'");
    expect("/meshes/0/primitives/0/material", 2, "/primitives/0/material", "2 is not an index of 'materials'");
    expect("/nodes/0/mesh", 5, "/nodes/0/mesh", "5 is not an index of 'meshes'");
    expect("/nodes/0/children", {0}, "/nodes/0", "cycle");
    expect("/nodes/0/scale", {1, 2}, "/nodes/0/scale", "3 numbers were expected");
    expect("/nodes/0/rotation", {0, 0, 0, 0}, "/nodes/0/rotation", "unit quaternion");
    expect("/nodes/0/scale", {1e308, 1e308, 1e308}, "/nodes", "");
    expect("/scenes/0/nodes", {4}, "/scenes", "4 is not an index of 'nodes'");
    expect("/scenes/0/nodes", json::array(), "", "shows no triangles");
    expect("/scene", 3, "/scene", "3 is not an index of 'scenes'");
    expect("/asset/version", "1.0", "/asset/version", "1.0");
    expect("/extensionsRequired", {"KHR_draco_mesh_compression"}, "/extensionsRequired", "KHR_draco_mesh_compression");
}

TEST_F(Gltf, MaterialMistakesAreAnsweredWithFileAndPlace) {
    const auto expect = [&](const json& material, const char* place, const char* what) {
        Model model = with("/meshes/0/primitives/0/material", 0);
        model.document["materials"] = {material};
        model.document["textures"] = {{{"source", 0}}, {{"source", 7}}, {{"source", 1}}, {{"source", 2}}};
        model.document["images"] = {{{"uri", kPngUri}},
                                    {{"bufferView", 0}, {"mimeType", "image/png"}},
                                    {{"bufferView", 44}, {"mimeType", "image/png"}}};
        if (std::string(place).find("bufferView") == std::string::npos) model.document["images"].erase(2);
        EXPECT_THAT(error(model), AllOf(HasSubstr("model.gltf:"), HasSubstr(place), HasSubstr(what))) << material;
    };
    const auto base_color = [](int texture) {
        return json{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}};
    };
    expect({{"pbrMetallicRoughness", {{"roughnessFactor", 2}}}}, "/roughnessFactor", "from 0 to 1");
    expect({{"emissiveFactor", {0, -1, 0}}}, "/materials/0/emissiveFactor/1", "-1");
    expect({{"alphaMode", "GLOW"}}, "/materials/0/alphaMode", "GLOW");
    expect(base_color(9), "/baseColorTexture/index", "9 is not an index of 'textures'");
    expect(base_color(1), "/textures/1/source", "7 is not an index of 'images'");
    expect(base_color(2), "/images/1", "cannot be decoded");
    expect(base_color(3), "bufferView", "44");
}

TEST_F(Gltf, IndexPastTheLastVertexIsRefused) {
    Model model = triangle();
    const int indices = model.add<uint16_t>("SCALAR", kUnsignedShort, {0, 1, 3});
    model.document["meshes"][0]["primitives"][0]["indices"] = indices;
    EXPECT_THAT(error(model), HasSubstr("index 3 (element 2) is past the last of 3 vertices"));
}

TEST_F(Gltf, IndicesThatMakeNoWholeTriangleAreRefused) {
    Model model = triangle();
    const int indices = model.add<uint16_t>("SCALAR", kUnsignedShort, {0, 1, 2, 0});
    model.document["meshes"][0]["primitives"][0]["indices"] = indices;
    EXPECT_THAT(error(model), HasSubstr("4 indices"));
}

TEST_F(Gltf, NotANumberIsRefused) {
    Model model = triangle();
    const uint32_t nan = 0x7fc00000;
    std::memcpy(model.bin.data() + 16, &nan, sizeof nan);
    EXPECT_THAT(error(model), AllOf(HasSubstr("/accessors/0"), HasSubstr("element 1 is not finite")));
}

TEST_F(Gltf, MissingAndTruncatedBuffersAreNamed) {
    const std::string path = triangle().write(folder_);
    std::filesystem::resize_file(std::filesystem::path(path).replace_extension(".bin"), 40);
    EXPECT_THAT(input_error([&] { load_scene(path); }), AllOf(HasSubstr("model.gltf"), HasSubstr("model.bin")));
    std::filesystem::remove(std::filesystem::path(path).replace_extension(".bin"));
    EXPECT_THAT(input_error([&] { load_scene(path); }), AllOf(HasSubstr("model.gltf"), HasSubstr("model.bin")));
}

TEST_F(Gltf, MissingImagesAreNamed) {
    Model model = triangle();
    model.document["images"] = {{{"uri", "none.png"}}};
    EXPECT_THAT(error(model), AllOf(HasSubstr("model.gltf"), HasSubstr("none.png")));
}

// Wherever a binary file is cut, and whatever length it claims, the answer is an error and never a crash.
TEST_F(Gltf, TruncatedBinaryFilesAreRefused) {
    const std::string whole = triangle().glb();
    for (size_t length = 0; length < whole.size(); length += 7) {
        std::string cut = whole.substr(0, length);
        EXPECT_THAT(input_error([&] { load_scene(folder_.write("cut.glb", cut)); }), HasSubstr("cut.glb"));
        if (length < 12) continue;
        const auto claimed = static_cast<uint32_t>(length);
        std::memcpy(cut.data() + 8, &claimed, sizeof claimed);
        EXPECT_THAT(input_error([&] { load_scene(folder_.write("cut.glb", cut)); }), HasSubstr("cut.glb"));
    }
}

TEST_F(Gltf, TextThatIsNoGltfIsRefused) {
    for (const char* text : {"", "{", "[]", "{}", "null", R"({"asset": 3})", R"({"asset": {"version": 2}})", "glTF"}) {
        EXPECT_THAT(input_error([&] { load_scene(folder_.write("model.gltf", text)); }), HasSubstr("model.gltf"))
            << text;
    }
}

// Real models, where they are at hand.
class RealModels : public testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("LIGHTSWEEP_TEST_ASSETS");
        if (folder == nullptr) GTEST_SKIP() << "LIGHTSWEEP_TEST_ASSETS names no folder";
        assets_ = folder;
    }
    std::filesystem::path assets_;
};

// The file brings tangents made by its authoring tool; those generated from its coordinates must be nearly the same.
TEST_F(RealModels, GeneratedTangentsAgreeWithAuthoredOnes) {
    const Scene scene = load_scene(assets_ / "WaterBottle/WaterBottle.gltf");
    EXPECT_EQ(scene.triangle_count(), 4510U);
    Geometry generated{.vertices = scene.vertices, .indices = scene.indices};
    make_tangents(generated);
    size_t close = 0;
    size_t same_hand = 0;
    for (size_t i = 0; i < scene.vertices.size(); ++i) {
        const glm::vec4 a = scene.vertices[i].tangent;
        const glm::vec4 b = generated.vertices[i].tangent;
        close += glm::dot(glm::vec3(a), glm::vec3(b)) > 0.95F ? 1 : 0;
        same_hand += a.w == b.w ? 1 : 0;
    }
    EXPECT_GT(close, scene.vertices.size() * 95 / 100);
    EXPECT_GT(same_hand, scene.vertices.size() * 99 / 100);
}

TEST_F(RealModels, NanosuitLoadsWithItsBlendedGlassAsOpaque) {
    const Scene scene = load_scene(assets_ / "Nanosuit/Nanosuit.gltf");
    EXPECT_EQ(scene.instances.size(), 7U);
    EXPECT_NEAR(static_cast<double>(scene.triangle_count()), 19'000.0, 500.0);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("drawn as opaque")));
    for (const Vertex& v : scene.vertices) {
        ASSERT_NEAR(glm::length(v.normal), 1.0, 1e-5);
        ASSERT_NEAR(glm::dot(v.normal, glm::vec3(v.tangent)), 0.0, 1e-5);
    }
}

}  // namespace
}  // namespace lightsweep
