// No malformed glTF file is read past its end or drawn silently wrong: each is answered with its file and place.
#include "tests/unit/scene/gltf_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace lightsweep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GltfMistake : public Gltf {};

TEST_F(GltfMistake, MistakesAreAnsweredWithFileAndPlace) {
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

TEST_F(GltfMistake, MaterialMistakesAreAnsweredWithFileAndPlace) {
    const auto expect = [&](const json& material, const char* place, const char* what) {
        GltfSource model = with("/meshes/0/primitives/0/material", 0);
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

TEST_F(GltfMistake, IndexPastTheLastVertexIsRefused) {
    GltfSource model = triangle();
    const int indices = model.add<uint16_t>("SCALAR", kUnsignedShort, {0, 1, 3});
    model.document["meshes"][0]["primitives"][0]["indices"] = indices;
    EXPECT_THAT(error(model), HasSubstr("index 3 (element 2) is past the last of 3 vertices"));
}

TEST_F(GltfMistake, IndicesThatMakeNoWholeTriangleAreRefused) {
    GltfSource model = triangle();
    const int indices = model.add<uint16_t>("SCALAR", kUnsignedShort, {0, 1, 2, 0});
    model.document["meshes"][0]["primitives"][0]["indices"] = indices;
    EXPECT_THAT(error(model), HasSubstr("4 indices"));
}

TEST_F(GltfMistake, NotANumberIsRefused) {
    GltfSource model = triangle();
    const uint32_t nan = 0x7fc00000;
    std::memcpy(model.bin.data() + 16, &nan, sizeof nan);
    EXPECT_THAT(error(model), AllOf(HasSubstr("/accessors/0"), HasSubstr("element 1 is not finite")));
}

TEST_F(GltfMistake, MissingAndTruncatedBuffersAreNamed) {
    const std::string path = triangle().write(folder_);
    std::filesystem::resize_file(std::filesystem::path(path).replace_extension(".bin"), 40);
    EXPECT_THAT(input_error([&] { load_scene(path); }), AllOf(HasSubstr("model.gltf"), HasSubstr("model.bin")));
    std::filesystem::remove(std::filesystem::path(path).replace_extension(".bin"));
    EXPECT_THAT(input_error([&] { load_scene(path); }), AllOf(HasSubstr("model.gltf"), HasSubstr("model.bin")));
}

TEST_F(GltfMistake, MissingImagesAreNamed) {
    GltfSource model = triangle();
    model.document["images"] = {{{"uri", "none.png"}}};
    EXPECT_THAT(error(model), AllOf(HasSubstr("model.gltf"), HasSubstr("none.png")));
}

// Wherever a binary file is cut, and whatever length it claims, the answer is an error and never a crash.
TEST_F(GltfMistake, TruncatedBinaryFilesAreRefused) {
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

TEST_F(GltfMistake, DeepNestingIsRefused) {
    json deep = json::array();
    for (int i = 0; i < 200; ++i) deep = json::array({std::move(deep)});
    EXPECT_THAT(error(with("/extras", deep)), HasSubstr("nests deeper than 100"));
    EXPECT_THAT(input_error([&] { load_scene(folder_.write("model.glb", with("/extras", deep).glb())); }),
                HasSubstr("nests deeper than 100"));
}

TEST_F(GltfMistake, TextThatIsNoGltfIsRefused) {
    for (const char* text : {"", "{", "[]", "{}", "null", R"({"asset": 3})", R"({"asset": {"version": 2}})", "glTF"}) {
        EXPECT_THAT(input_error([&] { load_scene(folder_.write("model.gltf", text)); }), HasSubstr("model.gltf"))
            << text;
    }
}

}  // namespace
}  // namespace lightsweep
