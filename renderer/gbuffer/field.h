// The fields of a G-buffer: what a Surface (shaders/lib/surface.glsl) is made of, one row each.
#pragma once

#include "renderer/frame/needs.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

enum class Field : uint8_t { position, normal, base_color, roughness, metallic, specular, emissive, model };

struct FieldInfo {
    std::string_view name;  ///< in layout files, and the member of Surface
    std::string_view glsl_type;
    std::string_view otherwise;  ///< GLSL value where the scene does not need the field
    bool (*needed)(const SceneNeeds&);
};

const FieldInfo& info(Field field);
const std::vector<std::string>& field_names();  ///< by value

}  // namespace lightsweep
