#include "renderer/frame/needs.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightsweep {

int SceneNeeds::model_count() const { return static_cast<int>(std::count(models.begin(), models.end(), true)); }

SceneNeeds SceneNeeds::with_all_code() const {
    SceneNeeds all = *this;
    all.models.fill(true);
    all.base_color_textures = all.metallic_roughness_textures = all.normal_textures = all.emissive_textures = true;
    all.alpha_masks = all.double_sided = true;
    all.directional_lights = all.spot_lights = true;
    return all;
}

std::vector<std::string> SceneNeeds::defines() const {
    std::vector<std::string> result;
    const auto add = [&](bool needed, const char* define) {
        if (needed) result.emplace_back(define);
    };
    const auto has = [&](ShadingModel model) { return models[static_cast<size_t>(model)]; };
    add(has(ShadingModel::ggx), "HAS_GGX");
    add(has(ShadingModel::blinn_phong), "HAS_BLINN_PHONG");
    add(has(ShadingModel::lambert), "HAS_LAMBERT");
    add(model_count() > 1, "MULTIPLE_MODELS");
    result.push_back(fmt::format("ONLY_MODEL {}u", static_cast<uint32_t>(first_model)));
    add(base_color_textures, "HAS_BASE_COLOR_TEXTURE");
    add(metallic_roughness_textures, "HAS_METALLIC_ROUGHNESS_TEXTURE");
    add(normal_textures, "HAS_NORMAL_TEXTURE");
    add(emissive_textures, "HAS_EMISSIVE_TEXTURE");
    add(alpha_masks, "HAS_ALPHA_MASK");
    add(double_sided, "HAS_DOUBLE_SIDED");
    add(directional_lights, "HAS_DIRECTIONAL_LIGHTS");
    add(spot_lights, "HAS_SPOT_LIGHTS");
    return result;
}

SceneNeeds scene_needs(const Scene& scene) {
    SceneNeeds needs;
    std::vector<bool> used(scene.materials.size(), false);
    for (const auto& instance : scene.instances) used[scene.meshes[instance.mesh].material] = true;
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        if (!used[i]) continue;
        const Material& m = scene.materials[i];
        needs.models[static_cast<size_t>(m.model)] = true;
        const bool ggx = m.model == ShadingModel::ggx;
        needs.roughness |= m.model != ShadingModel::lambert;
        needs.metallic |= ggx && m.metallic > 0.0F;
        needs.specular |= m.model == ShadingModel::blinn_phong && m.specular != glm::vec3(0.0F);
        needs.emissive |= m.emissive != glm::vec3(0.0F);
        needs.base_color_textures |= m.base_color_texture != kNoTexture;
        needs.metallic_roughness_textures |= m.metallic_roughness_texture != kNoTexture;
        needs.normal_textures |= m.normal_texture != kNoTexture;
        needs.emissive_textures |= m.emissive_texture != kNoTexture && m.emissive != glm::vec3(0.0F);
        needs.alpha_masks |= m.alpha_cutoff > 0.0F;
        needs.double_sided |= m.double_sided;
        needs.single_sided |= !m.double_sided;
    }
    if (needs.model_count() == 0) needs.models[0] = true;  // nothing to draw; the shader still needs a model
    needs.first_model = static_cast<ShadingModel>(std::ranges::find(needs.models, true) - needs.models.begin());
    for (const auto& light : scene.lights.fixed) {
        needs.directional_lights |= light.kind == LightKind::directional;
        needs.local_lights |= light.kind != LightKind::directional;
        needs.spot_lights |= light.kind == LightKind::spot;
    }
    if (scene.lights.generator) {
        needs.local_lights = true;
        needs.spot_lights |= scene.lights.generator->spot_share > 0.0;
    }
    needs.ambient = scene.ambient != glm::dvec3(0.0);
    needs.background = scene.background != glm::dvec3(0.0);
    needs.instances = scene.instances.size();
    needs.triangles = scene.triangle_count();
    return needs;
}

}  // namespace lightsweep
