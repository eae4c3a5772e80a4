#include "renderer/gbuffer/field.h"

#include "renderer/base/check.h"

#include <iterator>

namespace lightsweep {
namespace {

bool always(const SceneNeeds&) { return true; }

constexpr FieldInfo kFields[] = {
    {"position", "vec3", "vec3(0.0)", always},
    {"normal", "vec3", "vec3(0.0, 0.0, 1.0)", always},
    {"base_color", "vec3", "vec3(0.0)", always},
    {"roughness", "float", "1.0", [](const SceneNeeds& n) { return n.roughness; }},
    {"metallic", "float", "0.0", [](const SceneNeeds& n) { return n.metallic; }},
    {"specular", "vec3", "vec3(0.0)", [](const SceneNeeds& n) { return n.specular; }},
    {"emissive", "vec3", "vec3(0.0)", [](const SceneNeeds& n) { return n.emissive; }},
    {"model", "uint", "ONLY_MODEL", [](const SceneNeeds& n) { return n.model_count() > 1; }},
};

}  // namespace

const FieldInfo& info(Field field) {
    CHECK(static_cast<size_t>(field) < std::size(kFields));
    return kFields[static_cast<size_t>(field)];
}

const std::vector<std::string>& field_names() {
    static const auto names = [] {
        std::vector<std::string> result;
        for (const auto& field : kFields) result.emplace_back(field.name);
        return result;
    }();
    return names;
}

}  // namespace lightsweep
