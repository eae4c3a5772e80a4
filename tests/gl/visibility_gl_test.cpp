// What must hold for the visibility path alone: what it rebuilds of a surface is what its triangle says, in double
// precision, and the picture is forward's where that is hardest.
#include "bench/measure/surface_probes.h"
#include "renderer/reference/surfaces.h"
#include "renderer/reference/triangle.h"
#include "renderer/reference/view.h"
#include "tests/gl/fixture.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace lightsweep {
namespace {

std::string scene_file(const std::string& name, const std::string& json) {
    const auto file = std::filesystem::path(testing::TempDir()) / name;
    write_file_atomically(file, json);
    return file.string();
}

// Triangles whose vertices lie behind the eye (the ground, and a wall that the near plane cuts), huge ones, ones that
// are smaller than a pixel, far ones; double-sided ones seen from behind, mirrored or not.
std::string hard_triangles() {
    return scene_file("hard_triangles.json", R"({
        "summary": "triangles that are hard to meet",
        "materials": {
            "one": {"model": "lambert", "textures": {"base_color": {"checker": {"squares": 2, "colors": [[1, 1, 1], [0, 0, 0]]}}}},
            "both": {"model": "ggx", "roughness": 0.5, "double_sided": true}},
        "shapes": {
            "ground": {"plane": {"size": [20000, 20000], "uv_scale": [5000, 5000]}},
            "wall": {"quad": {"size": [60, 3], "uv_scale": [20, 1]}},
            "quad": {"quad": {"size": [0.5, 0.5]}},
            "ball": {"sphere": {"radius": 0.3}},
            "fine": {"sphere": {"radius": 0.004, "segments": 128, "rings": 64}},
            "moon": {"sphere": {"radius": 900, "segments": 64, "rings": 32}}},
        "instances": [
            {"shape": "ground", "material": "one"},
            {"shape": "wall", "material": "both", "translate": [0.7, 1.5, 0], "rotate_deg": [0, 90, 0]},
            {"shape": "quad", "material": "both", "translate": [-1.2, 1.8, -2]},
            {"shape": "quad", "material": "both", "translate": [-0.6, 1.8, -2], "rotate_deg": [0, 160, 0]},
            {"shape": "quad", "material": "both", "translate": [0, 1.8, -2], "scale": [-1, 1, 1]},
            {"shape": "quad", "material": "both", "translate": [0, 1.2, -2], "rotate_deg": [0, 160, 0], "scale": [-1, 1, 1]},
            {"shape": "ball", "material": "one", "translate": [-0.7, 1.1, -2], "scale": [1, -1, 1]},
            {"shape": "fine", "material": "one", "translate": [-0.01, 1.595, -0.04]},
            {"shape": "moon", "material": "one", "translate": [-2500, 1500, -7000]}],
        "camera": {"eye": [0, 1.6, 0], "target": [0, 1.5, -1], "near": 0.02, "far": 20000},
        "lights": {"fixed": [{"kind": "directional", "color": [2, 2, 2], "direction": [0.3, -1, -0.5]}], "default_count": 1},
        "ambient": [0.1, 0.1, 0.1]})");
}

/// One scene through the visibility path, and what its triangles say.
class Rebuilt {
  public:
    explicit Rebuilt(const std::string& scene_key)
        : scene_(scenes_.scene(scene_key)),
          subject_{scenes_.gpu_scene(scene_key), {}, kTestWidth, kTestHeight},
          visible_(draw_visibility(subject_, buffers_, shapes_)),
          surfaces_(reference_surfaces(scene_, scene_.camera, visible_)) {}

    struct Count {
        size_t pixels = 0, position = 0, normal = 0, uv = 0, uv_steps = 0;  ///< covered ones; and those that are off
    };
    /// `right` in lib/visible_surface.glsl becomes `wrong`.
    Count count_wrong(const std::string& right = "", const std::string& wrong = "");

  private:
    /// A value of the visibility path's shader where it evaluates the material, as a picture.
    Image draw(const std::string& value, const std::string& surface_text);

    SceneStore scenes_;
    const Scene& scene_;
    FrameBuffers buffers_;
    DrawShapes shapes_;
    Subject subject_;
    Visibility visible_;
    std::vector<ReferenceSurface> surfaces_;
};

Image Rebuilt::draw(const std::string& value, const std::string& surface_text) {
    const SceneNeeds& needs = subject_.scene.needs();
    const PathSetup setup{.needs = needs, .layout = load_layout("float32"), .hdr = gl::Format::RGBA32F};
    Path path = find_path("visibility").build(setup);
    path.passes.back().shader.replaced = {
        {"lib/visible_surface.glsl", surface_text},
        {"lib/shade.glsl", "vec3 shade(Surface s) { return s.emissive; }"},
        {"lib/material.glsl", said_differently(shader_text("lib/material.glsl"), "s.model = material.model;",
                                               "s.model = material.model; s.emissive = " + value + ";")}};
    post_tone_map.append(path);
    Arm arm(std::move(path), setup, subject_, buffers_, shapes_);
    arm.draw();
    return arm.hdr_image();
}

glm::dvec3 value_at(const Image& image, int x, int y) {
    const float* p = image.pixel(x, y);
    return {p[0], p[1], p[2]};
}

/// A triangle in double precision, and how far 32 bits may be off on it.
struct ExactTriangle {
    ExactTriangle(const Scene& scene, const VisibleTriangle& visible)
        : vertices(corners(scene, scene.meshes[scene.instances[visible.instance].mesh], visible.triangle)),
          placed(vertices, place(scene.instances[visible.instance], scene.camera.eye)),
          normal(glm::cross(placed.edge1, placed.edge2)) {
        double longest = 0.0;
        for (const auto& [a, b] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{0, 1}}) {
            farthest = std::max(farthest, glm::length(placed.at(a, b)));
        }
        for (const auto& edge : {placed.edge1, placed.edge2, placed.edge2 - placed.edge1}) {
            longest = std::max(longest, glm::length(edge));
        }
        height = glm::length(normal) / longest;
    }

    glm::dvec2 weights(const glm::dvec3& ray) const {
        return glm::dvec2(glm::dot(ray, glm::cross(placed.edge2, placed.corner)),
                          glm::dot(ray, glm::cross(placed.corner, placed.edge1))) /
               glm::dot(ray, normal);
    }
    glm::dvec2 uv(const glm::dvec2& weight) const {
        const glm::dvec2 uv0 = vertices[0]->uv;
        return uv0 + (glm::dvec2(vertices[1]->uv) - uv0) * weight.x + (glm::dvec2(vertices[2]->uv) - uv0) * weight.y;
    }
    /// Vertices are rounded to 2^-24 of their distance, sixteen times over; that shifts the plane, and where the ray
    /// meets it by as much over the cosine.
    double position_step(const glm::dvec3& ray) const {
        const double cosine = std::abs(glm::dot(ray, normal)) / (glm::length(ray) * glm::length(normal));
        return 16.0 * 0x1p-24 * farthest / cosine;
    }
    /// Of an attribute with these values at the vertices: the weights shift by that over the triangle's height.
    double attribute_step(const glm::dvec3& ray, double a, double b, double c) const {
        const double range = std::max({a, b, c}) - std::min({a, b, c});
        const double largest = std::max({std::abs(a), std::abs(b), std::abs(c)});
        return position_step(ray) / height * range + 16.0 * 0x1p-24 * largest;
    }

    std::array<const Vertex*, 3> vertices;
    PlacedTriangle placed;
    glm::dvec3 normal;
    double farthest = 0.0, height = 0.0;
};

Rebuilt::Count Rebuilt::count_wrong(const std::string& right, const std::string& wrong) {
    const std::string text = said_differently(shader_text("lib/visible_surface.glsl"), right, wrong);
    const Image position = draw("s.position", text), normal = draw("s.normal", text), uv = draw("vec3(uv, 0.0)", text);
    const Image step_x = draw("vec3(uv_per_pixel[0], 0.0)", text), step_y = draw("vec3(uv_per_pixel[1], 0.0)", text);
    const View view(scene_.camera, kTestWidth, kTestHeight);
    Count count;
    for (int y = 0; y < kTestHeight; ++y) {
        for (int x = 0; x < kTestWidth; ++x) {
            const size_t i = static_cast<size_t>(y) * kTestWidth + x;
            const VisibleTriangle& visible = visible_.triangles[i];
            if (visible.instance == kNoSurface) continue;
            ++count.pixels;
            const ExactTriangle triangle(scene_, visible);
            const glm::dvec3 ray = view.ray(x, y);
            const auto& v = triangle.vertices;
            const auto off = [](const glm::dvec3& a, const glm::dvec3& b, double allowed) {
                return !(glm::length(a - b) <= allowed);
            };
            count.position += off(value_at(position, x, y), surfaces_[i].position, triangle.position_step(ray)) ? 1 : 0;
            double normal_step = 0.0, uv_step = 0.0;
            for (int k = 0; k < 3; ++k) {
                // Mesh normals turn with the instance; their differences keep their lengths unless it is not rigid,
                // and these are scaled by 1 or -1 alone.
                normal_step += triangle.attribute_step(ray, v[0]->normal[k], v[1]->normal[k], v[2]->normal[k]);
            }
            for (int k = 0; k < 2; ++k) uv_step += triangle.attribute_step(ray, v[0]->uv[k], v[1]->uv[k], v[2]->uv[k]);
            count.normal += off(value_at(normal, x, y), surfaces_[i].normal, normal_step) ? 1 : 0;
            const glm::dvec2 exact_uv = triangle.uv(triangle.weights(ray));
            count.uv += off(value_at(uv, x, y), glm::dvec3(exact_uv, 0.0), uv_step) ? 1 : 0;

            // Quads of 2x2 pixels begin at even columns, and at even rows counted from below.
            const int x0 = x & ~1, y0 = kTestHeight - 1 - ((kTestHeight - 1 - y) & ~1);
            const glm::dvec3 first = view.ray(x0, y0), right_of = view.ray(x0 + 1, y0), above = view.ray(x0, y0 - 1);
            const double n = glm::dot(first, triangle.normal);
            // At a horizon, where a quad's rays meet the plane at far apart places or not at all, nothing is precise.
            if (!(glm::dot(right_of, triangle.normal) / n > 0.8 && glm::dot(above, triangle.normal) / n > 0.8))
                continue;
            const glm::dvec2 base = triangle.uv(triangle.weights(first));
            const glm::dvec2 dx = triangle.uv(triangle.weights(right_of)) - base;
            const glm::dvec2 dy = triangle.uv(triangle.weights(above)) - base;
            const double allowed = 1e-3 * (glm::length(dx) + glm::length(dy)) + 1e-7;
            const bool steps_off = off(value_at(step_x, x, y), glm::dvec3(dx, 0.0), allowed) ||
                                   off(value_at(step_y, x, y), glm::dvec3(dy, 0.0), allowed);
            count.uv_steps += steps_off ? 1 : 0;
        }
    }
    return count;
}

TEST(VisibleSurface, IsWhatItsTriangleSays) {
    const auto count = Rebuilt(hard_triangles()).count_wrong();
    EXPECT_GT(count.pixels, size_t{kTestWidth * kTestHeight / 2});
    EXPECT_EQ(count.position, 0U);
    EXPECT_EQ(count.normal, 0U);
    EXPECT_EQ(count.uv, 0U);
    EXPECT_EQ(count.uv_steps, 0U);
}

TEST(VisibleSurface, FaultsAreFound) {
    Rebuilt rebuilt(hard_triangles());
    const auto order =
        rebuilt.count_wrong("cross(edge2, corner), cross(corner, edge1)", "cross(corner, edge1), cross(edge2, corner)");
    EXPECT_GT(order.uv, order.pixels / 10) << "the weights of two vertices changed places";
    const auto quads = rebuilt.count_wrong("2.0 * floor(0.5 * frag_coord) + 0.5", "frag_coord");
    EXPECT_GT(quads.uv_steps, quads.pixels / 10) << "differences to the next pixel, not within the quad";
    const auto facing = rebuilt.count_wrong("(facing < 0.0) != mesh.mirrored", "facing < 0.0");
    EXPECT_GT(facing.normal, facing.pixels / 100) << "a mirrored instance turned inside out";
}

TEST(Visibility, MipLevelsAtGrazingAngles) {
    // A ground that ends far off, on which the texture repeats 400 times, and a wall along the view.
    Studio studio(scene_file("grazing.json", R"({
        "summary": "every mip level",
        "materials": {"checkered": {"model": "lambert",
            "textures": {"base_color": {"checker": {"squares": 2, "colors": [[1, 1, 1], [0, 0, 0]]}}}}},
        "shapes": {"ground": {"plane": {"size": [400, 400], "uv_scale": [400, 400]}},
                   "wall": {"quad": {"size": [100, 6], "uv_scale": [50, 3]}}},
        "instances": [{"shape": "ground", "material": "checkered"},
                      {"shape": "wall", "material": "checkered", "translate": [-2, 1, -50], "rotate_deg": [0, 90, 0]}],
        "camera": {"eye": [0, 1.6, 0], "target": [0.1, 1.5, -1], "far": 1000},
        "lights": {"default_count": 0}, "ambient": [1, 1, 1]})"));
    const Image forward = studio.hdr("forward", "", {}), image = studio.hdr("visibility", "", {});
    expect_close(forward, image, 1e-4, 1e-5, "grazing angles", studio.allowance("visibility", {}));
    EXPECT_GT(*std::max_element(image.rgb.begin(), image.rgb.end()), 0.3F);
}

TEST(Visibility, MoreMaterialsThanTheStencilHasNumbers) {
    constexpr int kColumns = 24, kRows = 13;  // 312 of them: 57 numbers are used twice
    std::string materials, instances;
    for (int i = 0; i < kColumns * kRows; ++i) {
        const char* comma = i == 0 ? "" : ",";
        materials += fmt::format(R"({}"m{}": {{"model": "lambert", "emissive": [{}, {}, 1]}})", comma, i,
                                 1 + i % kColumns, 1 + i / kColumns);
        instances += fmt::format(R"({}{{"shape": "quad", "material": "m{}", "translate": [{}, {}, 0]}})", comma, i,
                                 i % kColumns - 0.5 * (kColumns - 1), i / kColumns - 0.5 * (kRows - 1));
    }
    Studio studio(scene_file("materials.json", fmt::format(R"({{
        "summary": "a quad for each material", "materials": {{{}}}, "shapes": {{"quad": {{"quad": {{"size": [0.9, 0.9]}}}}}},
        "instances": [{}], "camera": {{"eye": [0, 0, 12], "target": [0, 0, 0]}}, "lights": {{"default_count": 0}}}})",
                                                           materials, instances)));
    const Image forward = studio.hdr("forward", "", {}), image = studio.hdr("visibility", "", {});
    EXPECT_EQ(forward.rgb, image.rgb);
    size_t lit = 0;
    for (size_t i = 2; i < image.rgb.size(); i += 3) lit += image.rgb[i] == 1.0F ? 1 : 0;
    EXPECT_GT(lit, image.pixel_count() / 2);
}

}  // namespace
}  // namespace lightsweep
