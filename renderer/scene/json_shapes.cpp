// "shapes" of a scene file.
#include "renderer/scene/scene_json.h"
#include "renderer/scene/shapes.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

constexpr double kSmallestLength = 1e-6;

double length(const JsonReader& json, std::string_view key, double otherwise) {
    return json.number_or(key, otherwise, kSmallestLength, kLargestLength);
}

int count(const JsonReader& json, std::string_view key, int otherwise, int low) {
    return static_cast<int>(json.integer_or(key, otherwise, low, 1024));
}

template <typename Shape>
Geometry read_flat(const JsonReader& json) {
    json.allow_keys({"size", "segments", "uv_scale"});
    Shape shape;
    if (const auto size = json.find("size")) shape.size = read_vec2(*size, kSmallestLength, kLargestLength);
    if (const auto segments = json.find("segments")) {
        const auto cells = segments->elements();
        if (cells.size() != 2) segments->fail(fmt::format("2 whole numbers were expected, not {}", cells.size()));
        shape.segments = {cells[0].integer(1, 1024), cells[1].integer(1, 1024)};
    }
    return make_shape(shape);
}

Geometry read_box(const JsonReader& json) {
    json.allow_keys({"size", "segments", "uv_scale"});
    BoxShape shape;
    shape.size = read_vec3_or(json, "size", shape.size, kSmallestLength, kLargestLength);
    shape.segments = count(json, "segments", shape.segments, 1);
    return make_shape(shape);
}

Geometry read_sphere(const JsonReader& json) {
    json.allow_keys({"radius", "segments", "rings", "uv_scale"});
    SphereShape shape;
    shape.radius = length(json, "radius", shape.radius);
    shape.segments = count(json, "segments", shape.segments, 3);
    shape.rings = count(json, "rings", shape.rings, 2);
    return make_shape(shape);
}

template <typename Shape>
Geometry read_round(const JsonReader& json) {
    json.allow_keys({"radius", "height", "segments", "uv_scale"});
    Shape shape;
    shape.radius = length(json, "radius", shape.radius);
    shape.height = length(json, "height", shape.height);
    shape.segments = count(json, "segments", shape.segments, 3);
    return make_shape(shape);
}

Geometry read_torus(const JsonReader& json) {
    json.allow_keys({"radius", "tube", "segments", "sides", "uv_scale"});
    TorusShape shape;
    shape.radius = length(json, "radius", shape.radius);
    shape.tube = length(json, "tube", shape.tube);
    shape.segments = count(json, "segments", shape.segments, 3);
    shape.sides = count(json, "sides", shape.sides, 3);
    if (shape.tube > shape.radius) json.fail("'tube' must be at most 'radius'");
    return make_shape(shape);
}

Geometry read_column(const JsonReader& json) {
    json.allow_keys({"radius", "height", "flutes", "tessellation", "rows", "uv_scale"});
    ColumnShape shape;
    shape.radius = length(json, "radius", shape.radius);
    shape.height = length(json, "height", shape.height);
    shape.flutes = count(json, "flutes", shape.flutes, 3);
    shape.tessellation = static_cast<int>(json.integer_or("tessellation", shape.tessellation, 1, 32));
    shape.rows = count(json, "rows", shape.rows, 1);
    if (shape.height < 4.0 * shape.radius) json.fail("'height' must be at least 4 times 'radius'");
    return make_shape(shape);
}

Geometry read_arch(const JsonReader& json) {
    json.allow_keys({"span", "width", "height", "depth", "segments", "uv_scale"});
    ArchShape shape;
    shape.span = length(json, "span", shape.span);
    shape.width = length(json, "width", shape.width);
    shape.height = length(json, "height", shape.height);
    shape.depth = length(json, "depth", shape.depth);
    shape.segments = count(json, "segments", shape.segments, 3);
    if (shape.span >= shape.width) json.fail("'span' must be less than 'width'");
    if (shape.height <= 0.5 * shape.span) json.fail("'height' must be more than half of 'span'");
    return make_shape(shape);
}

struct ShapeReader {
    const char* name;
    Geometry (*read)(const JsonReader& json);
};

constexpr ShapeReader kShapes[] = {
    {"arch", read_arch},
    {"box", read_box},
    {"column", read_column},
    {"cone", read_round<ConeShape>},
    {"cylinder", read_round<CylinderShape>},
    {"plane", read_flat<PlaneShape>},
    {"quad", read_flat<QuadShape>},
    {"sphere", read_sphere},
    {"torus", read_torus},
};

}  // namespace

Geometry read_shape(const JsonReader& json) {
    std::vector<std::string> names;
    for (const auto& shape : kShapes) names.emplace_back(shape.name);
    const auto [index, member] = read_variant(json, "shape", names);
    Geometry geometry = kShapes[index].read(member);
    if (const auto scale = member.find("uv_scale")) {
        const glm::vec2 factor = read_vec2(*scale, kSmallestLength, 1e6);
        for (auto& vertex : geometry.vertices) vertex.uv *= factor;
    }
    return geometry;
}

}  // namespace lightsweep
