// "materials" of a scene file.
#include "renderer/base/file.h"
#include "renderer/scene/image_decode.h"
#include "renderer/scene/scene_json.h"
#include "renderer/scene/texture_gen.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

glm::dvec3 read_color(const JsonReader& json) { return read_vec3(json, 0.0, 1.0); }

ColorPair read_colors(const JsonReader& json) {
    const auto colors = json.at("colors").elements();
    if (colors.size() != 2) json.at("colors").fail(fmt::format("2 colours were expected, not {}", colors.size()));
    return {read_color(colors[0]), read_color(colors[1])};
}

int read_int(const JsonReader& json, std::string_view key, int otherwise, int low, int high) {
    return static_cast<int>(json.integer_or(key, otherwise, low, high));
}

// Which procedural textures may stand where: a normal map is bumps, the others are colours.
Texture generate_texture(const JsonReader& json, bool srgb, bool normal_map) {
    static const std::vector<std::string> normal_names{"bumps"};
    static const std::vector<std::string> color_names{"checker", "holes", "noise"};
    const auto& names = normal_map ? normal_names : color_names;
    const auto [index, texture] = read_variant(json, "texture", names);
    const std::string& name = names[index];
    const TextureFormat format{.size = read_int(texture, "size", 256, 1, 4096), .srgb = srgb};
    if (name == "bumps") {
        texture.allow_keys({"size", "count", "height"});
        return make_bumps(format.size, read_int(texture, "count", 8, 1, 256),
                          texture.number_or("height", 0.1, 0.0, 4.0));
    }
    if (name == "holes") {
        texture.allow_keys({"size", "count", "radius", "color"});
        return make_holes(format, read_int(texture, "count", 8, 1, 256), texture.number_or("radius", 0.35, 0.0, 0.5),
                          read_color(texture.at("color")));
    }
    if (name == "noise") {
        texture.allow_keys({"size", "cells", "octaves", "seed", "colors"});
        return make_noise(format, read_int(texture, "cells", 8, 1, 256), read_int(texture, "octaves", 4, 1, 8),
                          static_cast<uint64_t>(texture.integer_or("seed", 1, 0, INT64_MAX)), read_colors(texture));
    }
    texture.allow_keys({"size", "squares", "colors"});
    const int squares = read_int(texture, "squares", 8, 2, 1024);
    if (squares % 2 != 0) texture.at("squares").fail("an even number was expected, so that the texture tiles");
    return make_checker(format, squares, read_colors(texture));
}

// Loads each distinct texture once. The key is its text in the file, and how it is stored.
class TextureReader {
  public:
    explicit TextureReader(Scene& scene) : scene_(scene) {}

    int read(const std::optional<JsonReader>& json, bool srgb, bool normal_map = false) {
        if (!json) return kNoTexture;
        const auto [found, is_new] =
            known_.try_emplace({json->value().dump(), srgb}, static_cast<int>(scene_.textures.size()));
        if (is_new) {
            scene_.textures.push_back(json->value().is_string() ? read_image(*json, srgb)
                                                                : generate_texture(*json, srgb, normal_map));
        }
        return found->second;
    }

  private:
    static Texture read_image(const JsonReader& json, bool srgb) {
        const std::string name = json.string();
        const auto path = json.file().parent_path() / name;
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) json.fail(fmt::format("there is no file {}", path.string()));
        return decode_image(read_file(path), name, srgb, path.string());
    }

    Scene& scene_;
    std::map<std::pair<std::string, bool>, int> known_;
};

void read_textures(const JsonReader& json, TextureReader& textures, Material& material) {
    if (material.model == ShadingModel::ggx) {
        json.allow_keys({"base_color", "metallic_roughness", "normal", "emissive"});
    } else {
        json.allow_keys({"base_color", "normal", "emissive"});
    }
    material.base_color_texture = textures.read(json.find("base_color"), true);
    material.metallic_roughness_texture = textures.read(json.find("metallic_roughness"), false);
    material.normal_texture = textures.read(json.find("normal"), false, true);
    material.emissive_texture = textures.read(json.find("emissive"), true);
}

void read_specular(const JsonReader& json, Material& material) {
    if (!json.value().is_string()) {
        material.specular = read_color(json);
        return;
    }
    static const std::vector<std::string> names{"luminance"};
    json.choice("specular", names);
    material.specular_from_luminance = true;
    material.specular = glm::vec3(1.0F);
}

// Each model takes only the keys that it uses, so that a value without effect is an error.
void allow_material_keys(const JsonReader& json, ShadingModel model) {
    switch (model) {
        case ShadingModel::ggx:
            json.allow_keys({"model", "base_color", "roughness", "metallic", "emissive", "normal_scale", "alpha_cutoff",
                             "double_sided", "textures"});
            break;
        case ShadingModel::blinn_phong:
            json.allow_keys({"model", "base_color", "roughness", "specular", "emissive", "normal_scale", "alpha_cutoff",
                             "double_sided", "textures"});
            break;
        case ShadingModel::lambert:
            json.allow_keys(
                {"model", "base_color", "emissive", "normal_scale", "alpha_cutoff", "double_sided", "textures"});
            break;
    }
}

Material read_material(const std::string& name, const JsonReader& json, TextureReader& textures) {
    Material material{.name = name};
    if (const auto model = json.find("model")) {
        material.model = static_cast<ShadingModel>(model->choice("model", kShadingModelNames));
    }
    allow_material_keys(json, material.model);
    material.base_color = read_vec3_or(json, "base_color", glm::dvec3(1.0), 0.0, 1.0);
    material.roughness = static_cast<float>(json.number_or("roughness", 1.0, 0.0, 1.0));
    material.metallic = static_cast<float>(json.number_or("metallic", 0.0, 0.0, 1.0));
    if (const auto specular = json.find("specular")) read_specular(*specular, material);
    material.emissive = read_vec3_or(json, "emissive", glm::dvec3(0.0), 0.0, 1e6);
    material.normal_scale = static_cast<float>(json.number_or("normal_scale", 1.0, -100.0, 100.0));
    material.alpha_cutoff = static_cast<float>(json.number_or("alpha_cutoff", 0.0, 0.0, 1.0));
    material.double_sided = json.boolean_or("double_sided", false);
    if (const auto member = json.find("textures")) read_textures(*member, textures, material);
    return material;
}

}  // namespace

std::map<std::string, Material> read_materials(const JsonReader& json, Scene& scene) {
    TextureReader textures(scene);
    std::map<std::string, Material> materials;
    for (const auto& [name, member] : json.members()) materials[name] = read_material(name, member, textures);
    return materials;
}

}  // namespace lightsweep
