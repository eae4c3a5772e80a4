// What a scene needs from a renderer, computed once, as data. Shaders, layouts, passes and what may be skipped are
// decided by this and by nothing else: the light count is not in it.
#pragma once

#include "renderer/scene/scene.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

struct SceneNeeds {
    std::array<bool, kShadingModelCount> models{};  ///< which ShadingModels occur
    ShadingModel first_model = ShadingModel::ggx;   ///< of those that occur
    bool roughness = false;                         ///< a model with a specular lobe occurs
    bool metallic = false;                          ///< some GGX material is metallic
    bool specular = false;                          ///< some Blinn-Phong material has a specular colour
    bool emissive = false;
    bool base_color_textures = false;
    bool metallic_roughness_textures = false;
    bool normal_textures = false;
    bool emissive_textures = false;
    bool alpha_masks = false;
    bool double_sided = false;  ///< some material is seen from both sides
    bool single_sided = false;  ///< some material is seen from its front alone
    bool directional_lights = false;
    bool local_lights = false;  ///< points or spots
    bool spot_lights = false;
    bool ambient = false;     ///< constant radiance from everywhere
    bool background = false;  ///< radiance where no surface is
    uint64_t instances = 0;
    uint64_t triangles = 0;  ///< of all instances

    int model_count() const;
    bool textures() const {
        return base_color_textures || metallic_roughness_textures || normal_textures || emissive_textures;
    }
    /// Whether surfaces or background show anything that no point or spot light brings.
    bool base() const { return emissive || ambient || directional_lights || background; }
    /// Whether instances can hide others, or lie outside of the view while others do not.
    bool several_instances() const { return instances > 1; }
    /// The same scene, drawn by shaders that can do everything: for renderers that do not specialise. What defines()
    /// turns into code is on; `first_model` and the rest stay as they are.
    SceneNeeds with_all_code() const;
    /// The HAS_* defines of shaders/lib, and ONLY_MODEL: the model where the G-buffer does not store it.
    std::vector<std::string> defines() const;
};

/// Calls visit(name, value) for everything above, with names as std::string_view and values as bool or uint64_t. The
/// only list of these names.
template <class Visit>
void visit_needs(const SceneNeeds& needs, Visit visit) {
    const auto say = [&](std::string_view name, auto value) { visit(name, value); };
    for (size_t i = 0; i < needs.models.size(); ++i) say(kShadingModelNames[i], needs.models[i]);
    say("roughness", needs.roughness);
    say("metallic", needs.metallic);
    say("specular", needs.specular);
    say("emissive", needs.emissive);
    say("base_color_textures", needs.base_color_textures);
    say("metallic_roughness_textures", needs.metallic_roughness_textures);
    say("normal_textures", needs.normal_textures);
    say("emissive_textures", needs.emissive_textures);
    say("alpha_masks", needs.alpha_masks);
    say("double_sided", needs.double_sided);
    say("single_sided", needs.single_sided);
    say("directional_lights", needs.directional_lights);
    say("local_lights", needs.local_lights);
    say("spot_lights", needs.spot_lights);
    say("ambient", needs.ambient);
    say("background", needs.background);
    say("instances", needs.instances);
    say("triangles", needs.triangles);
}

/// From the materials that instances use, and from the kinds of light that the scene's rig can make (not from how many
/// there are, so that a sweep over light counts keeps its shaders).
SceneNeeds scene_needs(const Scene& scene);

}  // namespace lightsweep
