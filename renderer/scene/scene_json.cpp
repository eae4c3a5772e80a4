#include "renderer/scene/scene_json.h"

#include "renderer/base/names.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

// A camera without a direction is refused: it would become NaN much later.
Camera read_camera(const JsonReader& json) {
    json.allow_keys({"eye", "target", "up", "fov_y_deg", "near", "far"});
    Camera camera;
    camera.eye = read_vec3(json.at("eye"), -kLargestLength, kLargestLength);
    camera.target = read_vec3(json.at("target"), -kLargestLength, kLargestLength);
    camera.up = read_vec3_or(json, "up", camera.up, -1.0, 1.0);
    camera.fov_y_deg = json.number_or("fov_y_deg", camera.fov_y_deg, 1.0, 170.0);
    camera.near_distance = json.number_or("near", camera.near_distance, 1e-6, kLargestLength);
    camera.far_distance = json.number_or("far", camera.far_distance, 1e-6, kLargestLength);
    if (camera.far_distance <= camera.near_distance) json.fail("'far' must be more than 'near'");
    const glm::dvec3 forward = camera.target - camera.eye;
    if (glm::length(forward) == 0.0) json.fail("'eye' and 'target' are the same point");
    if (glm::length(glm::cross(glm::normalize(forward), camera.up)) < 1e-6) {
        json.fail("'up' is along the view; choose another direction");
    }
    return camera;
}

}  // namespace

glm::dvec2 read_vec2(const JsonReader& json, double low, double high) {
    const auto numbers = json.numbers(2, low, high);
    return {numbers[0], numbers[1]};
}

glm::dvec3 read_vec3(const JsonReader& json, double low, double high) {
    const auto numbers = json.numbers(3, low, high);
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dvec3 read_vec3_or(const JsonReader& json, std::string_view key, const glm::dvec3& otherwise, double low,
                        double high) {
    const auto member = json.find(key);
    return member ? read_vec3(*member, low, high) : otherwise;
}

std::pair<size_t, JsonReader> read_variant(const JsonReader& json, std::string_view what,
                                           std::span<const std::string> names) {
    const auto members = json.members();
    if (members.size() != 1) json.fail(fmt::format("one {} was expected, not {}", what, members.size()));
    const auto& [name, member] = members.front();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) json.fail(unknown_name(what, name, names));
    return {static_cast<size_t>(found - names.begin()), member};
}

Scene read_scene_json(const std::filesystem::path& file) { return read_scene_json(JsonReader::from_file(file)); }

Scene read_scene_json(const JsonReader& json) {
    json.allow_keys({"summary", "materials", "shapes", "instances", "camera", "lights", "ambient", "background"});
    Scene scene;
    scene.summary = json.at("summary").string();
    scene.camera = read_camera(json.at("camera"));
    scene.lights = read_lights(json.at("lights"));
    scene.ambient = read_vec3_or(json, "ambient", scene.ambient, 0.0, 1e6);
    scene.background = read_vec3_or(json, "background", scene.background, 0.0, 1e6);

    std::map<std::string, Material> materials;
    if (const auto member = json.find("materials")) materials = read_materials(*member, scene);
    std::map<std::string, Geometry> shapes;
    if (const auto member = json.find("shapes")) {
        for (const auto& [name, shape] : member->members()) shapes[name] = read_shape(shape);
    }
    read_instances(json.at("instances"), materials, shapes, scene);
    return scene;
}

}  // namespace lightsweep
