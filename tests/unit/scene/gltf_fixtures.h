// glTF files made byte by byte, small enough to know what they must become.
#pragma once

#include "tests/unit/scene/scene_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace lightsweep {

using nlohmann::json;

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A file with one buffer, to which accessors are appended.
struct GltfSource {
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

inline constexpr int kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kFloat = 5126;

// One triangle facing +z, with normals and coordinates.
inline GltfSource triangle() {
    GltfSource model;
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
inline constexpr const char* kPngUri =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4z8DA8J8BAAf/"
    "Af8Bf4mnAAAAAElFTkSuQmCC";

class Gltf : public testing::Test {
  protected:
    Scene load(GltfSource model) { return load_scene(model.write(folder_)); }
    std::string error(GltfSource model) {
        return input_error([&] { load(std::move(model)); });
    }
    // The triangle with the value at `pointer` replaced or added.
    static GltfSource with(const char* pointer, const json& value) {
        GltfSource model = triangle();
        model.document[json::json_pointer(pointer)] = value;
        return model;
    }

    TempFolder folder_;
};

}  // namespace lightsweep
