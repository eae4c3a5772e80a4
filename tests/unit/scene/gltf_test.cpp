// What well-formed glTF files become.
#include "renderer/scene/gltf.h"

#include "tests/unit/scene/gltf_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace lightsweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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
    GltfSource embedded = triangle();
    embedded.document["buffers"] = {
        {{"uri",
          "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"
          "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAAAAAAAAAAAABAAIAAAA="},
         {"byteLength", embedded.bin.size() + 2}}};
    EXPECT_EQ(load_scene(folder_.write("model.gltf", embedded.document.dump())).content_hash, expected);
}

// The spec's formulas by hand: unsigned bytes c / 255; signed shorts max(c / 32767, -1).
TEST_F(Gltf, NormalisedIntegersAreScaled) {
    GltfSource model = triangle();
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
    GltfSource model = triangle();
    model.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    model.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int positions = model.add<uint16_t>("VEC3", kUnsignedShort, {0, 0, 0, 300, 0, 0, 0, 300, 0});
    model.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
    const Scene scene = load(model);
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(300, 0, 0));
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(Gltf, InterleavedDataIsRead) {
    GltfSource model = triangle();
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
    GltfSource model = triangle();
    model.document["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const Scene scene = load(model);
    for (const Vertex& v : scene.vertices) EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    expect_sound_frames(scene.vertices, scene.indices);
}

TEST_F(Gltf, NormalsOfLengthZeroAreReplacedWithAWarning) {
    GltfSource model = triangle();
    const int normals = model.add<float>("VEC3", kFloat, {0, 0, 1, 0, 0, 0, 0, 0, 1});
    model.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    const Scene scene = load(model);
    expect_sound_frames(scene.vertices, scene.indices);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("normals of length 0")));
}

TEST_F(Gltf, PrimitivesWithoutIndicesAndCoordinatesAreDrawn) {
    GltfSource model = triangle();
    auto& primitive = model.document["meshes"][0]["primitives"][0];
    primitive.erase("indices");
    primitive["attributes"].erase("TEXCOORD_0");
    const Scene scene = load(model);
    EXPECT_EQ(scene.triangle_count(), 1U);
    expect_sound_frames(scene.vertices, scene.indices);
}

TEST_F(Gltf, NodesMultiplyDownTheHierarchy) {
    GltfSource model = triangle();
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
    GltfSource model = with("/meshes/0/primitives/0/material", 0);
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
    GltfSource model = with("/meshes/0/primitives/0/material", 0);
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
