#include "renderer/scene/gltf_material.h"

#include "renderer/scene/image_decode.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace lightsweep {
namespace {

double checked(const GltfFile& file, double value, double high, const std::string& pointer) {
    if (value >= 0.0 && value <= high) return value;
    file.fail(pointer, fmt::format("a number from 0 to {} was expected, not {}", high, value));
}

// Hands out the scene's texture index for each (image, sRGB) that materials ask for; decodes them all at the end.
class TexturePool {
  public:
    TexturePool(const GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

    // `info` is a tinygltf::TextureInfo or NormalTextureInfo.
    int request(const auto& info, bool srgb, const std::string& pointer) {
        if (info.index < 0) return kNoTexture;
        const auto& model = file_.model;
        file_.check_index(info.index, model.textures.size(), "textures", pointer + "/index");
        const auto& texture = model.textures[static_cast<size_t>(info.index)];
        file_.check_index(texture.source, model.images.size(), "images",
                          fmt::format("/textures/{}/source", info.index));
        if (info.texCoord != 0) {
            warn_once(scene_.warnings, file_, "texture coordinates other than TEXCOORD_0 are replaced by it");
        }
        if (texture.sampler >= 0) check_sampler(texture.sampler, info.index);
        const auto [found, is_new] = wanted_.try_emplace({texture.source, srgb}, jobs_.size());
        if (is_new) jobs_.push_back({texture.source, srgb});
        return static_cast<int>(scene_.textures.size() + found->second);
    }

    void decode() {
        std::vector<Texture> textures(jobs_.size());
        tbb::parallel_for(size_t{0}, jobs_.size(), [&](size_t i) {
            const auto& image = file_.model.images[static_cast<size_t>(jobs_[i].image)];
            const std::string pointer = fmt::format("/images/{}", jobs_[i].image);
            const std::span<const unsigned char> bytes =
                image.bufferView >= 0 ? view_bytes(file_, image.bufferView, pointer + "/bufferView") : image.image;
            const std::string name = !image.uri.empty() ? image.uri : !image.name.empty() ? image.name : pointer;
            textures[i] = decode_image({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, jobs_[i].srgb,
                                       fmt::format("{}:{}", file_.path, pointer));
        });
        for (auto& texture : textures) scene_.textures.push_back(std::move(texture));
    }

  private:
    struct Job {
        int image;
        bool srgb;
    };

    void check_sampler(int index, int texture) {
        file_.check_index(index, file_.model.samplers.size(), "samplers", fmt::format("/textures/{}/sampler", texture));
        const auto& sampler = file_.model.samplers[static_cast<size_t>(index)];
        if (sampler.wrapS != TINYGLTF_TEXTURE_WRAP_REPEAT || sampler.wrapT != TINYGLTF_TEXTURE_WRAP_REPEAT) {
            warn_once(scene_.warnings, file_, "clamped or mirrored textures are repeated");
        }
        if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
            warn_once(scene_.warnings, file_, "nearest-filtered textures are filtered linearly");
        }
    }

    const GltfFile& file_;
    Scene& scene_;
    std::map<std::pair<int, bool>, size_t> wanted_;
    std::vector<Job> jobs_;
};

Material convert(const GltfFile& file, int index, TexturePool& textures, std::vector<std::string>& warnings) {
    Material material{.name = "default", .metallic = 1.0F};
    if (index == kDefaultGltfMaterial) return material;
    const auto& source = file.model.materials[static_cast<size_t>(index)];
    const auto& pbr = source.pbrMetallicRoughness;
    const std::string here = fmt::format("/materials/{}", index);
    const std::string pbr_here = here + "/pbrMetallicRoughness";
    material.name = source.name.empty() ? here.substr(1) : source.name;
    for (int k = 0; k < 3; ++k) {
        const auto channel = static_cast<size_t>(k);
        material.base_color[k] = static_cast<float>(
            checked(file, pbr.baseColorFactor[channel], 1.0, fmt::format("{}/baseColorFactor/{}", pbr_here, k)));
        material.emissive[k] = static_cast<float>(
            checked(file, source.emissiveFactor[channel], 1e6, fmt::format("{}/emissiveFactor/{}", here, k)));
    }
    material.roughness = static_cast<float>(checked(file, pbr.roughnessFactor, 1.0, pbr_here + "/roughnessFactor"));
    material.metallic = static_cast<float>(checked(file, pbr.metallicFactor, 1.0, pbr_here + "/metallicFactor"));
    material.base_color_texture = textures.request(pbr.baseColorTexture, true, pbr_here + "/baseColorTexture");
    material.metallic_roughness_texture =
        textures.request(pbr.metallicRoughnessTexture, false, pbr_here + "/metallicRoughnessTexture");
    material.normal_texture = textures.request(source.normalTexture, false, here + "/normalTexture");
    material.emissive_texture = textures.request(source.emissiveTexture, true, here + "/emissiveTexture");
    if (std::abs(source.normalTexture.scale) > 1e3) file.fail(here + "/normalTexture/scale", "is past 1000");
    material.normal_scale = static_cast<float>(source.normalTexture.scale);
    material.double_sided = source.doubleSided;
    if (source.occlusionTexture.index >= 0) warn_once(warnings, file, "occlusion textures are ignored");

    if (source.alphaMode == "MASK") {
        // The factor scales alpha; dividing the cutoff by it is the same test. At alpha 0 nothing is left.
        const double alpha = checked(file, pbr.baseColorFactor[3], 1.0, pbr_here + "/baseColorFactor/3");
        const double cutoff = checked(file, source.alphaCutoff, 1e6, here + "/alphaCutoff");
        material.alpha_cutoff = static_cast<float>(alpha > 0.0 ? cutoff / alpha : cutoff > 0.0 ? 2.0 : 0.0);
    } else if (source.alphaMode == "BLEND") {
        warn_once(warnings, file, fmt::format("the blended material '{}' is drawn as opaque", material.name));
    } else if (source.alphaMode != "OPAQUE") {
        file.fail(here + "/alphaMode", fmt::format("unknown mode '{}'; known: OPAQUE, MASK, BLEND", source.alphaMode));
    }
    return material;
}

}  // namespace

std::map<int, uint32_t> append_gltf_materials(const GltfFile& file, const std::set<int>& indices, Scene& scene) {
    std::map<int, uint32_t> result;
    TexturePool textures(file, scene);
    for (const int index : indices) {
        result[index] = static_cast<uint32_t>(scene.materials.size());
        scene.materials.push_back(convert(file, index, textures, scene.warnings));
    }
    textures.decode();
    return result;
}

}  // namespace lightsweep
