// Scene files in JSON; scenes/README.md documents them.
#pragma once

#include "renderer/base/json_reader.h"
#include "renderer/scene/geometry.h"

#include <filesystem>
#include <map>

namespace lightsweep {

/// Reads a whole scene file; key and content_hash are left to the caller. Throws InputError with file, JSON pointer and
/// what is allowed for everything the format does not say.
Scene read_scene_json(const std::filesystem::path& file);
/// The same of a document read already; files that it names lie beside the document's own.
Scene read_scene_json(const JsonReader& json);

/// The parts of it, each in a file of its own. Coordinates and lengths are kept below this, so that no product of them
/// leaves the range of a float.
inline constexpr double kLargestLength = 1e9;

glm::dvec2 read_vec2(const JsonReader& json, double low, double high);
glm::dvec3 read_vec3(const JsonReader& json, double low, double high);
/// The member `key`, or `otherwise`.
glm::dvec3 read_vec3_or(const JsonReader& json, std::string_view key, const glm::dvec3& otherwise, double low,
                        double high);
/// The name of the only member of an object such as {"sphere": {...}}, one of `names`, and the member.
std::pair<size_t, JsonReader> read_variant(const JsonReader& json, std::string_view what,
                                           std::span<const std::string> names);

/// "materials": by name. Their textures are appended to the scene.
std::map<std::string, Material> read_materials(const JsonReader& json, Scene& scene);
/// One of "shapes".
Geometry read_shape(const JsonReader& json);
/// "instances", drawn in the order of the list; appends their meshes and the materials in use.
void read_instances(const JsonReader& json, const std::map<std::string, Material>& materials,
                    const std::map<std::string, Geometry>& shapes, Scene& scene);
/// "lights".
LightRig read_lights(const JsonReader& json);

}  // namespace lightsweep
