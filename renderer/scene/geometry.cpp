#include "renderer/scene/geometry.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

namespace lightsweep {
namespace {

// Some unit vector across `normal`: the axis least along it, made orthogonal.
glm::dvec3 any_tangent(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    glm::dvec3 axis(1.0, 0.0, 0.0);
    if (size.y <= size.x && size.y <= size.z) axis = {0.0, 1.0, 0.0};
    if (size.z <= size.x && size.z <= size.y) axis = {0.0, 0.0, 1.0};
    return glm::normalize(axis - normal * glm::dot(normal, axis));
}

// A corner that MikkTSpace would weld: equal bits of position, normal and coordinates, and one handedness.
struct CornerKey {
    std::array<float, 8> values;
    bool mirrored;
    bool operator==(const CornerKey& other) const = default;
};

struct CornerHash {
    size_t operator()(const CornerKey& key) const {
        return hash_bytes({reinterpret_cast<const char*>(key.values.data()), sizeof key.values}, key.mirrored ? 1 : 0);
    }
};

CornerKey corner_key(const Vertex& v, bool mirrored) {
    // + 0.0 makes -0 the same bits as 0, as operator== sees them.
    return {{v.position.x + 0.0F, v.position.y + 0.0F, v.position.z + 0.0F, v.normal.x + 0.0F, v.normal.y + 0.0F,
             v.normal.z + 0.0F, v.uv.x + 0.0F, v.uv.y + 0.0F},
            mirrored};
}

// How position follows the texture coordinates over one triangle.
struct TangentFrame {
    glm::dvec3 tangent{0.0};  // dP/du, not unit; zero where the coordinates say nothing
    bool mirrored = false;    // the image is seen mirrored from the front
};

TangentFrame triangle_frame(const Vertex& a, const Vertex& b, const Vertex& c) {
    const glm::dvec3 edge1 = glm::dvec3(b.position) - glm::dvec3(a.position);
    const glm::dvec3 edge2 = glm::dvec3(c.position) - glm::dvec3(a.position);
    const glm::dvec2 uv1 = glm::dvec2(b.uv) - glm::dvec2(a.uv);
    const glm::dvec2 uv2 = glm::dvec2(c.uv) - glm::dvec2(a.uv);
    const double area = uv1.x * uv2.y - uv2.x * uv1.y;
    if (area == 0.0) return {};
    // v runs down the image: counter-clockwise in space is clockwise in (u, v), so the unmirrored area is negative.
    return {(edge1 * uv2.y - edge2 * uv1.y) / area, area > 0.0};
}

double corner_angle(const Vertex& at, const Vertex& next, const Vertex& previous) {
    const glm::dvec3 a = glm::dvec3(next.position) - glm::dvec3(at.position);
    const glm::dvec3 b = glm::dvec3(previous.position) - glm::dvec3(at.position);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// `vector` laid into the plane across `normal`, unit; zero when nothing is left of it.
glm::dvec3 project(const glm::dvec3& vector, const glm::dvec3& normal) {
    const glm::dvec3 across = vector - normal * glm::dot(normal, vector);
    const double length = glm::length(across);
    return length > 1e-12 * glm::length(vector) && std::isfinite(length) ? across / length : glm::dvec3(0.0);
}

}  // namespace

Vertex make_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                   const glm::dvec2& uv) {
    // sin(pi) is not zero: poles and seams would not close.
    const auto snap = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };
    return {.position = glm::dvec3(snap(position.x), snap(position.y), snap(position.z)),
            .normal = normal,
            .tangent = glm::vec4(tangent, 1.0F),
            .uv = uv};
}

void add_patch(Geometry& geometry, int columns, int rows, const std::function<Vertex(double u, double v)>& surface) {
    CHECK_THAT(columns >= 1 && rows >= 1, "columns = {}, rows = {}", columns, rows);
    const auto base = static_cast<uint32_t>(geometry.vertices.size());
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            geometry.vertices.push_back(surface(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
        }
    }
    const auto add_triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
        const auto& v = geometry.vertices;
        if (v[a].position == v[b].position || v[b].position == v[c].position || v[c].position == v[a].position) return;
        geometry.indices.insert(geometry.indices.end(), {a, b, c});
    };
    const auto stride = static_cast<uint32_t>(columns) + 1;
    for (uint32_t j = 0; j < static_cast<uint32_t>(rows); ++j) {
        for (uint32_t i = 0; i < static_cast<uint32_t>(columns); ++i) {
            const uint32_t top = base + j * stride + i;
            const uint32_t bottom = top + stride;
            add_triangle(top, bottom, bottom + 1);
            add_triangle(top, bottom + 1, top + 1);
        }
    }
}

void make_flat_normals(Geometry& geometry) {
    std::vector<Vertex> corners;
    corners.reserve(geometry.indices.size());
    for (size_t i = 0; i + 2 < geometry.indices.size(); i += 3) {
        const glm::dvec3 a = geometry.vertices[geometry.indices[i]].position;
        const glm::dvec3 b = geometry.vertices[geometry.indices[i + 1]].position;
        const glm::dvec3 c = geometry.vertices[geometry.indices[i + 2]].position;
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        for (size_t k = i; k < i + 3; ++k) {
            corners.push_back(geometry.vertices[geometry.indices[k]]);
            // A triangle without area covers no pixel: any unit vector will do.
            corners.back().normal = length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0);
        }
    }
    geometry.vertices = std::move(corners);
    for (size_t i = 0; i < geometry.indices.size(); ++i) geometry.indices[i] = static_cast<uint32_t>(i);
}

void make_tangents(Geometry& geometry) {
    auto& vertices = geometry.vertices;
    auto& indices = geometry.indices;

    std::unordered_map<CornerKey, glm::dvec3, CornerHash> sums;
    sums.reserve(vertices.size());
    std::vector<bool> corner_mirrored(indices.size());
    for (size_t i = 0; i < indices.size(); i += 3) {
        const std::array<const Vertex*, 3> corner{&vertices[indices[i]], &vertices[indices[i + 1]],
                                                  &vertices[indices[i + 2]]};
        const TangentFrame frame = triangle_frame(*corner[0], *corner[1], *corner[2]);
        for (size_t k = 0; k < 3; ++k) {
            const Vertex& v = *corner[k];
            const double angle = corner_angle(v, *corner[(k + 1) % 3], *corner[(k + 2) % 3]);
            sums[corner_key(v, frame.mirrored)] += project(frame.tangent, v.normal) * angle;
            corner_mirrored[i + k] = frame.mirrored;
        }
    }

    enum : uint8_t { unused, upright, mirrored };
    std::vector<uint8_t> use(vertices.size(), unused);
    std::unordered_map<uint32_t, uint32_t> split;  // a vertex seen first with one handedness -> its copy with the other
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint8_t handed = corner_mirrored[i] ? mirrored : upright;
        const uint32_t vertex = indices[i];
        if (use[vertex] == handed) continue;
        if (use[vertex] == unused) {
            use[vertex] = handed;
        } else {
            const auto [copy, is_new] = split.try_emplace(vertex, static_cast<uint32_t>(vertices.size()));
            if (is_new) {
                vertices.push_back(Vertex(vertices[vertex]));
                use.push_back(handed);
            }
            indices[i] = copy->second;
        }
    }
    for (size_t i = 0; i < vertices.size(); ++i) {
        Vertex& v = vertices[i];
        const auto sum = sums.find(corner_key(v, use[i] == mirrored));
        glm::dvec3 tangent = sum == sums.end() ? glm::dvec3(0.0) : project(sum->second, v.normal);
        if (tangent == glm::dvec3(0.0)) tangent = any_tangent(v.normal);
        v.tangent = glm::vec4(tangent, use[i] == mirrored ? -1.0F : 1.0F);
    }
}

Mesh append_geometry(Scene& scene, const Geometry& geometry, std::string name, const std::string& place) {
    constexpr size_t kMost = std::numeric_limits<uint32_t>::max();
    if (scene.vertices.size() + geometry.vertices.size() > kMost ||
        scene.indices.size() + geometry.indices.size() > kMost) {
        throw InputError(place, "the scene would hold more than 2^32 - 1 vertices or indices");
    }
    Mesh mesh{.name = std::move(name),
              .first_index = static_cast<uint32_t>(scene.indices.size()),
              .index_count = static_cast<uint32_t>(geometry.indices.size()),
              .bounds = {}};
    const auto base = static_cast<uint32_t>(scene.vertices.size());
    for (const uint32_t index : geometry.indices) {
        scene.indices.push_back(base + index);
        mesh.bounds.include(geometry.vertices[index].position);
    }
    scene.vertices.insert(scene.vertices.end(), geometry.vertices.begin(), geometry.vertices.end());
    return mesh;
}

Bounds transformed(const Bounds& bounds, const glm::dmat4& transform) {
    Bounds result;
    if (bounds.empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                           (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                           (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
        result.include(glm::dvec3(transform * glm::dvec4(p, 1.0)));
    }
    return result;
}

}  // namespace lightsweep
