#include "renderer/frame/skip_needs.h"

#include "renderer/base/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace lightsweep {
namespace {

// "roughness, metallic, specular and 2 more": a line holds no more.
std::string list_text(const std::vector<std::string>& words) {
    constexpr size_t kMostNamed = 5;
    const size_t named = words.size() > kMostNamed ? kMostNamed - 1 : words.size();
    std::string text;
    for (size_t i = 0; i < named; ++i) text += (i == 0 ? "" : ", ") + words[i];
    if (named < words.size()) text += fmt::format(" and {} more", words.size() - named);
    return text;
}

SkipUse use_when(bool may_help, std::string why, std::string why_not) {
    return {may_help, may_help ? std::move(why) : std::move(why_not)};
}

SkipUse of_instances(const SceneNeeds& needs, const char* why, const char* why_not) {
    const auto text = [&](const char* words) {
        return fmt::format("{} instance{}: {}", needs.instances, needs.instances == 1 ? "" : "s", words);
    };
    return use_when(needs.several_instances(), text(why), text(why_not));
}

SkipUse of_lights(const SceneNeeds& needs, const char* why) {
    return use_when(needs.local_lights, why, "no point or spot light, whose reach would end");
}

// Position, normal and base colour are needed by every scene; the rest is as in renderer/gbuffer/field.cpp.
SkipUse of_fields(const SceneNeeds& needs) {
    std::vector<std::string> unneeded;
    const std::pair<bool, const char*> fields[] = {{needs.roughness, "roughness"},
                                                   {needs.metallic, "metallic"},
                                                   {needs.specular, "specular"},
                                                   {needs.emissive, "emissive"},
                                                   {needs.model_count() > 1, "model"}};
    for (const auto& [needed, name] : fields) {
        if (!needed) unneeded.emplace_back(name);
    }
    return use_when(!unneeded.empty(), "no surface needs " + list_text(unneeded), "surfaces need every field");
}

// "HAS_NORMAL_TEXTURE" as "normal texture".
std::string define_words(std::string define) {
    if (define.starts_with("HAS_")) define.erase(0, 4);
    std::ranges::transform(define, define.begin(),
                           [](unsigned char c) { return c == '_' ? ' ' : static_cast<char>(std::tolower(c)); });
    return define;
}

SkipUse of_code(const SceneNeeds& needs) {
    const auto used = needs.defines();
    std::vector<std::string> lacking;
    for (const auto& define : needs.with_all_code().defines()) {
        if (std::ranges::find(used, define) == used.end()) lacking.push_back(define_words(define));
    }
    return use_when(!lacking.empty(), "lacks " + list_text(lacking), "uses all that the shaders can do");
}

SkipUse of_passes(const SceneNeeds& needs) {
    if (!needs.base()) return {true, "no emission, ambient or directional light, no background: the base pass"};
    if (!needs.local_lights) return {true, "no point or spot light: their passes"};
    return {true, "the passes of lights, in frames that none reaches"};
}

}  // namespace

SkipUse skip_use(Skip skip, const SceneNeeds& needs) {
    switch (skip) {
        case Skip::frustum:
            return of_instances(needs, "some may lie outside of the view", "what the view is of");
        case Skip::light_frustum:
            return of_lights(needs, "lights may reach nothing that the view shows");
        case Skip::light_lists:
            return of_lights(needs, "lights may reach a part of the view alone");
        case Skip::light_depth:
            return of_lights(needs, "lights may end in front of surfaces, or begin behind them");
        case Skip::occlusion:
            return of_instances(needs, "some may be hidden", "nothing can hide it");
        case Skip::backface:
            return use_when(needs.single_sided, "single-sided materials: their back faces are never seen",
                            "every material is seen from both sides");
        case Skip::sort:
            return of_instances(needs, "some may cover others", "nothing to order");
        case Skip::fields:
            return of_fields(needs);
        case Skip::passes:
            return of_passes(needs);
        case Skip::code:
            return of_code(needs);
        case Skip::background:
            return {true, "pixels without a surface, where the view shows some"};
        case Skip::clears:
            return {true, "a matter of the path's targets, not of the scene"};
        case Skip::cells:
            return {true, "a matter of the sweep, not of the scene"};
    }
    CHECK_THAT(false, "skip = {}", static_cast<int>(skip));
}

}  // namespace lightsweep
