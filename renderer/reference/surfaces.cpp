#include "renderer/reference/surfaces.h"

#include "renderer/base/check.h"
#include "renderer/reference/triangle.h"
#include "renderer/reference/view.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>

namespace lightsweep {
namespace {

// What a surface without textures samples.
constexpr SampledTexels kNoTexels{
    .base_color = {1, 1, 1}, .roughness = 1, .normal = {0.5F, 0.5F, 1}, .metallic = 1, .emissive = {1, 1, 1}};

// A point of a triangle's plane: how much of each vertex it is, and where it lies.
struct PlanePoint {
    glm::dvec3 weights;
    glm::dvec3 position;
};

constexpr double kShortest = 1e-8;  // sums of unit vectors below this have cancelled out

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > kShortest ? v / length : otherwise;
}

// A tiny vector has a direction all the same; only zero has none, and stays zero.
glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

// Where the ray meets the plane. Nothing when it does so outside of what the camera can see: then the plane is seen
// edge-on, or the triangle has none, and the rasteriser saw a rounded triangle that says nothing about the exact one.
std::optional<PlanePoint> meet(const PlacedTriangle& t, const glm::dvec3& ray, const Camera& camera) {
    const glm::dvec3 normal = glm::cross(t.edge1, t.edge2);
    // The ray is one unit long along the view axis, so this is a view distance.
    const double distance = glm::dot(normal, t.corner) / glm::dot(normal, ray);
    if (!(distance > 0.5 * camera.near_distance && distance < 2.0 * camera.far_distance)) return std::nullopt;
    const glm::dvec3 position = ray * distance;
    const glm::dvec3 across = (position - t.corner) / glm::dot(normal, normal);
    const double weight1 = glm::dot(glm::cross(across, t.edge2), normal);
    const double weight2 = glm::dot(glm::cross(t.edge1, across), normal);
    return PlanePoint{{1.0 - weight1 - weight2, weight1, weight2}, position};
}

// What a rasteriser interpolates that rounds the vertices' window positions to 2^-bits pixels and keeps their
// distances. Nothing when a vertex is not in front of the near plane (it is clipped first, each device in its own way)
// or nothing is left of the triangle.
std::optional<PlanePoint> interpolate_snapped(const PlacedTriangle& t, const View& view, int x, int y,
                                              const Camera& camera, int subpixel_bits) {
    const glm::dvec3 vertices[3] = {t.corner, t.at(1.0, 0.0), t.at(0.0, 1.0)};
    const glm::dvec2 center(x + 0.5, y + 0.5);
    glm::dvec2 seen[3];  // from the pixel's centre: exact, as both are multiples of the grid's step
    for (int i = 0; i < 3; ++i) {
        if (view.distance(vertices[i]) <= camera.near_distance) return std::nullopt;
        const glm::dvec2 window = view.window(vertices[i]);
        for (int k = 0; k < 2; ++k)
            seen[i][k] = std::ldexp(std::nearbyint(std::ldexp(window[k], subpixel_bits)), -subpixel_bits) - center[k];
    }
    // Twice the area that the centre makes with each opposite edge, over the distance: the perspective weights.
    glm::dvec3 weights;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 &a = seen[(i + 1) % 3], &b = seen[(i + 2) % 3];
        weights[i] = (a.x * b.y - a.y * b.x) / view.distance(vertices[i]);
    }
    weights /= weights.x + weights.y + weights.z;
    if (!std::isfinite(weights.x + weights.y + weights.z)) return std::nullopt;
    return PlanePoint{weights, t.at(weights.y, weights.z)};
}

// A tangent along the normal has no direction across it: any other one takes its place, with the same handedness.
glm::dvec4 usable_tangent(const glm::dvec3& normal, const glm::dvec4& tangent) {
    constexpr double kSmallestSine = 1e-3;
    const glm::dvec3 along(tangent);
    const double bitangent = glm::length(glm::cross(normal, along) * tangent.w);
    if (bitangent > kSmallestSine * glm::length(normal) * glm::length(along)) return tangent;
    const glm::dvec3 across = std::abs(normal.x) > std::abs(normal.z) ? glm::dvec3(-normal.y, normal.x, 0.0)
                                                                      : glm::dvec3(0.0, -normal.z, normal.y);
    return {unit_or(across, {1.0, 0.0, 0.0}), tangent.w < 0.0 ? -1.0 : 1.0};
}

glm::dvec3 mapped_normal(const glm::dvec3& mapped, const glm::dvec3& normal, const glm::dvec4& tangent) {
    const glm::dvec3 along(tangent);
    return along * mapped.x + glm::cross(normal, along) * (tangent.w * mapped.y) + normal * mapped.z;
}

glm::dvec3 shading_normal(const std::array<const Vertex*, 3>& vertices, const PlacedInstance& placed,
                          const glm::dvec3& geometric, const glm::dvec3& weights, const Material& material,
                          const SampledTexels& texels) {
    constexpr double kShortestMapped = 1e-4;  // steps of 1/255, filtered to less, point anywhere
    glm::dvec3 normal(0.0);
    for (int i = 0; i < 3; ++i)
        normal += weights[i] * unit_or_zero(placed.for_normals * glm::dvec3(vertices[i]->normal));
    if (!(glm::length(normal) > kShortest)) normal = geometric;
    const glm::dvec3 unit = glm::normalize(normal);
    if (material.normal_texture == kNoTexture) return unit;

    glm::dvec3 mapped = 2.0 * glm::dvec3(texels.normal) - 1.0;
    mapped.x *= static_cast<double>(material.normal_scale);
    mapped.y *= static_cast<double>(material.normal_scale);
    if (glm::length(mapped) < kShortestMapped) return unit;

    glm::dvec4 tangent(0.0);
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 along = unit_or_zero(placed.linear * glm::dvec3(vertices[i]->tangent));
        if (along == glm::dvec3(0.0)) along = {1.0, 0.0, 0.0};
        const double handedness = placed.mirrored ? -vertices[i]->tangent.w : vertices[i]->tangent.w;
        tangent += weights[i] * glm::dvec4(along, handedness);
    }
    return unit_or(mapped_normal(mapped, normal, usable_tangent(normal, tangent)), unit);
}

// Counter-clockwise triangles face the viewer; a mirrored instance's are clockwise.
bool seen_from_behind(const PlacedTriangle& t, const PlacedInstance& placed) {
    const double towards_eye = -glm::dot(glm::cross(t.edge1, t.edge2), t.corner);
    return (placed.mirrored ? -towards_eye : towards_eye) < 0.0;
}

// Of the triangle's front; up where it has no area.
glm::dvec3 front_normal(const PlacedTriangle& t, const PlacedInstance& placed) {
    const glm::dvec3 normal = unit_or_zero(glm::cross(t.edge1, t.edge2));
    if (normal == glm::dvec3(0.0)) return {0.0, 1.0, 0.0};
    return placed.mirrored ? -normal : normal;
}

ReferenceSurface with_material(const Material& material, const SampledTexels& texels) {
    ReferenceSurface s;
    s.base_color = glm::dvec3(material.base_color) * glm::dvec3(texels.base_color);
    s.specular = material.specular;
    // Luminance of ITU-R BT.709.
    if (material.specular_from_luminance) s.specular *= glm::dot(s.base_color, glm::dvec3(0.2126, 0.7152, 0.0722));
    s.emissive = glm::dvec3(material.emissive) * glm::dvec3(texels.emissive);
    s.roughness = static_cast<double>(material.roughness) * static_cast<double>(texels.roughness);
    s.metallic = static_cast<double>(material.metallic) * static_cast<double>(texels.metallic);
    s.model = material.model;
    s.covered = true;
    return s;
}

}  // namespace

std::vector<ReferenceSurface> reference_surfaces(const Scene& scene, const Camera& camera, const Visibility& visible,
                                                 int subpixel_bits) {
    const size_t pixels = static_cast<size_t>(visible.width) * static_cast<size_t>(visible.height);
    CHECK_THAT(visible.triangles.size() == pixels, "{} of {} pixels", visible.triangles.size(), pixels);
    CHECK_THAT(visible.texels.empty() || visible.texels.size() == pixels, "{} of {} texels", visible.texels.size(),
               pixels);
    CHECK_THAT(subpixel_bits >= 0 && subpixel_bits <= 32, "subpixel_bits = {}", subpixel_bits);

    const View view(camera, visible.width, visible.height);
    std::vector<PlacedInstance> placed;
    placed.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances) placed.push_back(place(instance, camera.eye));

    const auto surface_of = [&](int x, int y) {
        const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(visible.width) + static_cast<size_t>(x);
        const VisibleTriangle seen = visible.triangles[pixel];
        if (seen.instance == kNoSurface) return ReferenceSurface{};
        CHECK_THAT(seen.instance < placed.size(), "instance {} of {}", seen.instance, placed.size());
        const PlacedInstance& instance = placed[seen.instance];
        const Mesh& mesh = scene.meshes[scene.instances[seen.instance].mesh];
        const Material& material = scene.materials[mesh.material];
        const SampledTexels& texels = visible.texels.empty() ? kNoTexels : visible.texels[pixel];

        const auto vertices = corners(scene, mesh, seen.triangle);
        const PlacedTriangle triangle(vertices, instance);
        std::optional<PlanePoint> point;
        if (subpixel_bits > 0) point = interpolate_snapped(triangle, view, x, y, camera, subpixel_bits);
        if (!point) point = meet(triangle, view.ray(x, y), camera);
        if (!point) point = {glm::dvec3(1.0 / 3.0), triangle.at(1.0 / 3.0, 1.0 / 3.0)};

        ReferenceSurface s = with_material(material, texels);
        s.position = point->position;
        s.normal =
            shading_normal(vertices, instance, front_normal(triangle, instance), point->weights, material, texels);
        if (material.double_sided && seen_from_behind(triangle, instance)) s.normal = -s.normal;
        return s;
    };

    std::vector<ReferenceSurface> surfaces(pixels);
    tbb::parallel_for(0, visible.height, [&](int y) {
        ReferenceSurface* row = surfaces.data() + static_cast<size_t>(y) * static_cast<size_t>(visible.width);
        for (int x = 0; x < visible.width; ++x) row[x] = surface_of(x, y);
    });
    return surfaces;
}

}  // namespace lightsweep
