// What a scene needs from a renderer, computed once, as data. Shaders, layouts and passes are specialised by this and
// by nothing else: the light count is not in it.
#pragma once

#include "renderer/scene/scene.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace lightsweep {

struct SceneNeeds {
    std::array<bool, kShadingModelCount> models{};  ///< which ShadingModels occur
    bool roughness = false;                         ///< a model with a specular lobe occurs
    bool metallic = false;                          ///< some GGX material is metallic
    bool specular = false;                          ///< some Blinn-Phong material has a specular colour
    bool emissive = false;
    bool base_color_textures = false;
    bool metallic_roughness_textures = false;
    bool normal_textures = false;
    bool emissive_textures = false;
    bool alpha_masks = false;
    bool double_sided = false;
    bool directional_lights = false;
    bool spot_lights = false;

    int model_count() const;
    bool textures() const {
        return base_color_textures || metallic_roughness_textures || normal_textures || emissive_textures;
    }
    /// The HAS_* defines of shaders/lib.
    std::vector<std::string> defines() const;
};

/// From the materials that instances use, and from the kinds of light that the scene's rig can make (not from how many
/// there are, so that a sweep over light counts keeps its shaders).
SceneNeeds scene_needs(const Scene& scene);

}  // namespace lightsweep
