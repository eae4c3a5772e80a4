// "lights" of a scene file.
#include "renderer/scene/scene_json.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

constexpr double kSmallestRadius = 1e-6;
constexpr double kLargestIntensity = 1e9;

void read_cone(const JsonReader& json, double& inner_deg, double& outer_deg) {
    inner_deg = json.number_or("inner_deg", inner_deg, 0.0, 90.0);
    outer_deg = json.number_or("outer_deg", outer_deg, 0.0, 90.0);
    if (inner_deg >= outer_deg) json.fail("'inner_deg' must be less than 'outer_deg'");
}

Light read_light(const JsonReader& json) {
    static const std::vector<std::string> kinds{"point", "spot", "directional"};
    Light light;
    light.kind = static_cast<LightKind>(json.at("kind").choice("kind", kinds));
    switch (light.kind) {
        case LightKind::point:
            json.allow_keys({"kind", "color", "position", "radius"});
            break;
        case LightKind::spot:
            json.allow_keys({"kind", "color", "position", "radius", "direction", "inner_deg", "outer_deg"});
            break;
        case LightKind::directional:
            json.allow_keys({"kind", "color", "direction"});
            break;
    }
    light.color = read_vec3(json.at("color"), 0.0, kLargestIntensity);
    if (light.kind != LightKind::directional) {
        light.position = read_vec3(json.at("position"), -kLargestLength, kLargestLength);
        light.radius = json.at("radius").number(kSmallestRadius, kLargestLength);
    }
    if (light.kind != LightKind::point) {
        const JsonReader direction = json.at("direction");
        light.direction = read_vec3(direction, -1e6, 1e6);
        if (glm::length(light.direction) < 1e-9) direction.fail("has no direction");
        light.direction = glm::normalize(light.direction);
    }
    if (light.kind == LightKind::spot) read_cone(json, light.inner_deg, light.outer_deg);
    return light;
}

LightGenerator read_generator(const JsonReader& json) {
    static const std::vector<std::string> placements{"grid", "random", "surface"};
    LightGenerator generator;
    generator.placement = static_cast<Placement>(json.at("placement").choice("placement", placements));
    if (generator.placement == Placement::surface) {
        json.allow_keys({"placement", "height", "seed", "radius", "intensity", "saturation", "spot_share", "inner_deg",
                         "outer_deg"});
        if (const auto height = json.find("height")) {
            const glm::dvec2 range = read_vec2(*height, 0.0, kLargestLength);
            if (range.x > range.y) height->fail("the lowest and the highest were expected, in this order");
            generator.height_min = range.x;
            generator.height_max = range.y;
        }
    } else {
        json.allow_keys({"placement", "bounds", "seed", "radius", "intensity", "saturation", "spot_share", "inner_deg",
                         "outer_deg"});
        const JsonReader bounds = json.at("bounds");
        bounds.allow_keys({"low", "high"});
        generator.bounds.low = read_vec3(bounds.at("low"), -kLargestLength, kLargestLength);
        generator.bounds.high = read_vec3(bounds.at("high"), -kLargestLength, kLargestLength);
        if (glm::any(glm::greaterThan(generator.bounds.low, generator.bounds.high))) {
            bounds.fail("'low' must not be above 'high'");
        }
    }
    generator.seed = static_cast<uint64_t>(json.integer_or("seed", 1, 0, INT64_MAX));
    generator.radius = json.at("radius").number(kSmallestRadius, kLargestLength);
    generator.intensity = json.at("intensity").number(0.0, kLargestIntensity);
    generator.saturation = json.number_or("saturation", generator.saturation, 0.0, 1.0);
    generator.spot_share = json.number_or("spot_share", generator.spot_share, 0.0, 1.0);
    read_cone(json, generator.inner_deg, generator.outer_deg);
    return generator;
}

}  // namespace

LightRig read_lights(const JsonReader& json) {
    json.allow_keys({"fixed", "generator", "default_count", "default_overlap"});
    LightRig rig;
    if (const auto fixed = json.find("fixed")) {
        for (const auto& light : fixed->elements()) rig.fixed.push_back(read_light(light));
    }
    if (const auto generator = json.find("generator")) rig.generator = read_generator(*generator);
    const int64_t most = rig.generator ? 1'000'000 : static_cast<int64_t>(rig.fixed.size());
    rig.default_count = static_cast<int>(json.at("default_count").integer(0, most));
    rig.default_overlap = json.number_or("default_overlap", 0.0, 0.0, 1e6);
    if (rig.default_overlap > 0.0 && !rig.generator) {
        json.at("default_overlap").fail("only generated lights follow it, and there is no 'generator'");
    }
    return rig;
}

}  // namespace lightsweep
