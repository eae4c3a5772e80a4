// What must hold between the GPU and the double-precision reference: with nothing packed they differ by what 32-bit
// arithmetic explains, and a wrong formula in a shader does not hide.
#include "bench/measure/cell_error.h"
#include "bench/measure/reference_store.h"
#include "bench/stats/quantile.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"
#include "renderer/post/post.h"
#include "renderer/reference/reference.h"
#include "tests/gl/fixture.h"

#include <gmock/gmock.h>

#include <fmt/format.h>
#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace lightsweep {
namespace {

constexpr double kMedian = 2e-6;            // of the relative error: 32-bit arithmetic over a frame's formulas
constexpr double kUnusual = 1e-4;           // above it, a pixel must have a reason
constexpr double kRoundings = 4 * 0x1p-24;  // of a value that is a sum of products
// A pixel is explained when its error is at most this many times what moving the surface by those roundings does,
// summed over the directions: each step stands for a few roundings of its kind, not for their worst case.
constexpr double kExplained = 2.0;

/// One scene from its camera, on the GPU and in double.
class Truth {
  public:
    explicit Truth(const std::string& scene_key, int light_count = 24, int width = 320, int height = 180)
        : scene_(scenes_.scene(scene_key)),
          subject_{scenes_.gpu_scene(scene_key), make_lights(scene_, light_count, {scene_.lights.default_overlap}),
                   width, height},
          visibility_(draw_visibility(subject_, buffers_, shapes_)),
          surfaces_(reference_surfaces(scene_, scene_.camera, visibility_)) {}

    const Scene& scene() const { return scene_; }
    const SceneNeeds& needs() const { return subject_.scene.needs(); }
    const Visibility& visibility() const { return visibility_; }
    const std::vector<ReferenceSurface>& surfaces() const { return surfaces_; }
    std::vector<glm::dvec3> shade(std::span<const ReferenceSurface> surfaces) const {
        return shade_reference(scene_, surfaces, subject_.width, subject_.height, scene_.camera, subject_.lights);
    }

    /// A path with nothing packed; `replaced` shader text may hold a planted fault.
    Image draw(const std::string& path_key, const std::map<std::string, std::string>& replaced = {},
               ListBuilder light_lists = ListBuilder::cpu) {
        const PathSetup setup{.needs = needs(),
                              .layout = drop_unneeded(load_layout("float32"), needs()),
                              .hdr = gl::Format::RGBA32F,
                              .light_lists = light_lists};
        Path path = find_path(path_key).build(setup);
        for (auto& pass : path.passes) {
            pass.shader.replaced = replaced;
            for (auto& stage : pass.more_stages) stage.shader.replaced = replaced;
        }
        post_tone_map.append(path);
        Arm arm(std::move(path), setup, subject_, buffers_, shapes_);
        arm.draw();
        return arm.hdr_image();
    }
    std::vector<DecodedSurface> decoded(const std::string& layout) {
        const PathSetup setup{
            .needs = needs(), .layout = drop_unneeded(load_layout(layout), needs()), .hdr = gl::Format::RGBA32F};
        return draw_decoded_surface(setup, subject_, buffers_, shapes_);
    }

  private:
    SceneStore scenes_;
    const Scene& scene_;
    FrameBuffers buffers_;
    DrawShapes shapes_;
    Subject subject_;
    Visibility visibility_;
    std::vector<ReferenceSurface> surfaces_;
};

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

glm::dvec3 pixel_of(const Image& image, size_t i) {
    return {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]};
}

// How far 32-bit interpolation may put what a pixel gets from its triangle.
struct InterpolationStep {
    double position = 0.0, normal = 0.0;
};

// Roundings of 2^-24: some for the transform, and the interpolation's. That works with the vertices' window
// coordinates, known to 2^-24 of the target's size; over a triangle of `height` pixels at its narrowest that moves the
// weights by 2^-24 size / height, and so the attribute by that much of its difference over the triangle.
InterpolationStep interpolation_step(const Truth& truth, size_t pixel) {
    const VisibleTriangle& visible = truth.visibility().triangles[pixel];
    const Scene& scene = truth.scene();
    const Instance& instance = scene.instances[visible.instance];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dvec2 size(truth.visibility().width, truth.visibility().height);
    const glm::dmat4 clip_from_camera =
        camera_projection(scene.camera, truth.visibility().width, truth.visibility().height, DepthConvention::reversed);
    const glm::dmat3 normal_matrix = glm::inverseTranspose(glm::dmat3(instance.transform));
    glm::dvec3 position[3], normal[3];
    glm::dvec2 window[3];
    for (size_t k = 0; k < 3; ++k) {
        const Vertex& vertex = scene.vertices[scene.indices[mesh.first_index + 3 * visible.triangle + k]];
        position[k] = glm::dvec3(instance.transform * glm::dvec4(vertex.position, 1.0)) - scene.camera.eye;
        normal[k] = glm::normalize(normal_matrix * glm::dvec3(vertex.normal));
        const glm::dvec4 clip = clip_from_camera * glm::dvec4(position[k], 1.0);
        // Behind the eye there is no window: the clipped part is as large as the target.
        window[k] = clip.w > 1e-6 ? glm::dvec2(clip) / clip.w * 0.5 * size : size * static_cast<double>(k % 2);
    }
    double longest = 0.0, position_range = 0.0, normal_range = 0.0;
    for (size_t k = 0; k < 3; ++k) {
        const size_t next = (k + 1) % 3;
        longest = std::max(longest, glm::length(window[next] - window[k]));
        position_range = std::max(position_range, glm::length(position[next] - position[k]));
        normal_range = std::max(normal_range, glm::length(normal[next] - normal[k]));
    }
    const glm::dvec2 a = window[1] - window[0], b = window[2] - window[0];
    const double height = std::abs(a.x * b.y - a.y * b.x) / longest;
    const double amplified = std::max(size.x, size.y) / height;
    return {.position = kRoundings * (glm::length(truth.surfaces()[pixel].position) + amplified * position_range),
            .normal = kRoundings * (1.0 + amplified * normal_range)};
}

// How far each pixel's radiance moves when what the GPU rounds is moved that far.
struct Conditioning {
    std::vector<double> position;  ///< along three axes, as far as the transform rounds: a light's rim, a near light
    std::vector<double> normal;    ///< in its two directions: a sharp highlight, cancellation at a grazing light
    std::vector<double> sliver;    ///< both, as far as interpolation over a narrow triangle rounds
};

// Sums over the directions in which a surface is moved by its pixel's step.
template <class StepOf>
void add_movements(const Truth& truth, const std::vector<glm::dvec3>& radiance, int first, int end, StepOf step_of,
                   std::vector<double>& moved) {
    for (int direction = first; direction < end; ++direction) {
        std::vector<ReferenceSurface> surfaces = truth.surfaces();
        for (size_t i = 0; i < surfaces.size(); ++i) {
            ReferenceSurface& s = surfaces[i];
            if (!s.covered) continue;
            const InterpolationStep step = step_of(i);
            if (direction < 3) {
                s.position[direction] += step.position;
                continue;
            }
            const glm::dvec3 aside = std::abs(s.normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
            glm::dvec3 along = glm::normalize(glm::cross(s.normal, aside));
            if (direction == 4) along = glm::cross(s.normal, along);
            s.normal = glm::normalize(s.normal + step.normal * along);
        }
        const auto other = truth.shade(surfaces);
        for (size_t i = 0; i < radiance.size(); ++i) moved[i] += largest(other[i] - radiance[i]);
    }
}

Conditioning conditioning(const Truth& truth, const std::vector<glm::dvec3>& radiance) {
    const std::vector<double> none(radiance.size(), 0.0);
    Conditioning result{none, none, none};
    const auto transform = [&](size_t i) {
        return InterpolationStep{.position = kRoundings * glm::length(truth.surfaces()[i].position),
                                 .normal = kRoundings};
    };
    add_movements(truth, radiance, 0, 3, transform, result.position);
    add_movements(truth, radiance, 3, 5, transform, result.normal);
    add_movements(
        truth, radiance, 0, 5, [&](size_t i) { return interpolation_step(truth, i); }, result.sliver);
    return result;
}

// By how much each pixel's radiance moves when the texels do that a path samples with texture coordinates of its own:
// the reference takes the rasteriser's. Empty for paths that sample as the reference's texels were.
std::vector<double> sampling(Truth& truth, const std::string& path) {
    if (path != "visibility") return {};
    const Image movement =
        attribute_movement(std::max(truth.visibility().width, truth.visibility().height),
                           [&](const ReplacedText& replaced) { return truth.draw("forward", replaced); });
    std::vector<double> moved(movement.pixel_count());
    for (size_t i = 0; i < moved.size(); ++i) moved[i] = largest(pixel_of(movement, i));
    return moved;
}

struct Judgement {
    double median = 0.0;   ///< of the relative error over covered, lit, finite pixels
    size_t pixels = 0;     ///< of those
    size_t nonfinite = 0;  ///< pixels of the picture
    size_t unusual = 0;    ///< above kUnusual; each is in one of these classes:
    size_t by_position = 0, by_normal = 0, by_both = 0, by_sliver = 0, by_texel = 0, unexplained = 0;
    std::string text;
};

Judgement judge(const Truth& truth, const Image& image, const std::vector<double>& sampling = {}) {
    const auto radiance = truth.shade(truth.surfaces());
    const Conditioning moved = conditioning(truth, radiance);
    Judgement result;
    std::vector<double> errors;
    size_t worst = 0;
    double worst_excess = 0.0;
    for (size_t i = 0; i < radiance.size(); ++i) {
        const glm::dvec3 v = pixel_of(image, i);
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
            ++result.nonfinite;
            continue;
        }
        const double scale = largest(radiance[i]), error = largest(v - radiance[i]);
        if (scale > 0.0 && truth.surfaces()[i].covered) errors.push_back(error / scale);
        if (error <= kUnusual * scale) continue;
        ++result.unusual;
        const auto within = [&](double movement) { return error <= kExplained * movement + kUnusual * scale; };
        if (within(moved.position[i])) {
            ++result.by_position;
        } else if (within(moved.normal[i])) {
            ++result.by_normal;
        } else if (within(moved.position[i] + moved.normal[i])) {
            ++result.by_both;
        } else if (within(moved.sliver[i])) {
            ++result.by_sliver;
        } else if (!sampling.empty() && within(moved.sliver[i] + sampling[i])) {
            ++result.by_texel;
        } else {
            ++result.unexplained;
            const double excess = error / (kExplained * moved.sliver[i] + kUnusual * scale);
            if (excess > worst_excess) {
                worst_excess = excess;
                worst = i;
            }
        }
    }
    if (!errors.empty()) result.median = median(errors);
    result.pixels = errors.size();
    result.text = fmt::format(
        "median {:.2e}; of {} pixels {} above {:.0e}: {} by position, {} by normal, {} by both, {} by a sliver, {} by "
        "texels, {} unexplained; {} not finite",
        result.median, result.pixels, result.unusual, kUnusual, result.by_position, result.by_normal, result.by_both,
        result.by_sliver, result.by_texel, result.unexplained, result.nonfinite);
    if (result.unexplained > 0) {
        const auto width = static_cast<size_t>(image.width);
        const glm::dvec3 r = radiance[worst], v = pixel_of(image, worst);
        result.text +=
            fmt::format("; the worst at ({}, {}), {:.3g} times what is explained: ({}, {}, {}) became ({}, {}, {})",
                        worst % width, worst / width, worst_excess, r.x, r.y, r.z, v.x, v.y, v.z);
    }
    if (std::getenv("LIGHTSWEEP_TEST_VERBOSE") != nullptr) fmt::print("{}\n", result.text);
    return result;
}

void expect_explained(const Truth& truth, const Image& image, const std::string& what,
                      const std::vector<double>& sampling = {}) {
    const Judgement judgement = judge(truth, image, sampling);
    ASSERT_GT(judgement.pixels, 0U) << what;
    EXPECT_LT(judgement.median, kMedian) << what << ": " << judgement.text;
    EXPECT_EQ(judgement.unexplained, 0U) << what << ": " << judgement.text;
    EXPECT_EQ(judgement.nonfinite, 0U) << what << ": " << judgement.text;
}

void expect_every_path_explained(Truth& truth, const std::string& what) {
    for (const auto& path : path_keys()) {
        expect_explained(truth, truth.draw(path), what + " " + path, sampling(truth, path));
        if (!find_path(path).uses_light_lists) continue;
        expect_explained(truth, truth.draw(path, {}, ListBuilder::compute), what + " " + path + " compute");
    }
}

class EverySceneReference : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, EverySceneReference, testing::ValuesIn(resource_keys("scenes", ".json")),
                         [](const auto& c) { return c.param; });

TEST_P(EverySceneReference, NamesTrianglesThatExist) {
    const Truth truth(GetParam(), 0, 131, 77);
    size_t covered = 0;
    for (const auto& visible : truth.visibility().triangles) {
        if (visible.instance == kNoSurface) continue;
        ++covered;
        ASSERT_LT(visible.instance, truth.scene().instances.size());
        const Mesh& mesh = truth.scene().meshes[truth.scene().instances[visible.instance].mesh];
        ASSERT_LT(visible.triangle, mesh.index_count / 3);
    }
    EXPECT_GT(covered, truth.visibility().triangles.size() / 4);
}

TEST_P(EverySceneReference, SurfacesAreWhatTheGpuInterpolates) {
    Truth truth(GetParam());
    const auto decoded = truth.decoded("float32");
    const LayoutError layout = layout_error(truth.surfaces(), decoded, truth.needs());
    EXPECT_EQ(layout.lost_px, 0);
    ASSERT_GE(layout.fields.size(), 3U);
    for (const auto& error : layout.fields) {
        // Half of all pixels are within a few roundings of 2^-24; a mean may be held up by a few grazing triangles.
        EXPECT_LT(error.mean, error.unit == "deg" ? 1e-4 : 2e-6) << error.field;
    }
    for (size_t i = 0; i < decoded.size(); ++i) ASSERT_EQ(decoded[i].covered, truth.surfaces()[i].covered) << i;
}

TEST_P(EverySceneReference, TheControlIsWithinRounding) {
    Truth truth(GetParam());
    expect_explained(truth, truth.draw("deferred"), GetParam() + " deferred");
}

TEST_P(EverySceneReference, EveryPathIsWithinRounding) {
    Truth truth(GetParam(), 16, 160, 90);
    expect_every_path_explained(truth, GetParam());
}

// Scenes of one's own, given as LIGHTSWEEP_TEST_SCENES=FILE,FILE: too large, or not free, to be shipped.
TEST(UsersScenes, AreWithinRounding) {
    const char* files = std::getenv("LIGHTSWEEP_TEST_SCENES");
    if (files == nullptr) GTEST_SKIP() << "LIGHTSWEEP_TEST_SCENES names no scene";
    for (const auto& file : split(files, ',')) {
        Truth truth(file, 64);
        expect_every_path_explained(truth, file);
    }
}

// A normal turns towards the viewer where a double-sided surface is seen from behind, mirrored or not: winding, culling
// and gl_FrontFacing must agree with the geometry in every octant.
TEST(DoubleSided, MirroredInstancesFaceTheViewer) {
    const auto file = std::filesystem::path(testing::TempDir()) / "mirrored.json";
    write_file_atomically(file, R"({
        "summary": "every way to mirror and to turn round",
        "materials": {
            "both": {"model": "ggx", "roughness": 0.5, "double_sided": true,
                     "textures": {"normal": {"bumps": {"count": 4, "height": 0.2}}}},
            "one": {"model": "lambert"}},
        "shapes": {"quad": {"quad": {"size": [2, 2]}}, "ball": {"sphere": {"radius": 0.8}}},
        "instances": [
            {"shape": "quad", "material": "both", "translate": [-4, 1, 0]},
            {"shape": "quad", "material": "both", "translate": [-1.5, 1, 0], "scale": [-1, 1, 1]},
            {"shape": "quad", "material": "both", "translate": [1.5, 1, 0], "rotate_deg": [0, 180, 0]},
            {"shape": "quad", "material": "both", "translate": [4, 1, 0], "rotate_deg": [0, 180, 0], "scale": [-1, 1, 1]},
            {"shape": "ball", "material": "one", "translate": [-2, -1.2, 0], "scale": [1, -1, 1]},
            {"shape": "ball", "material": "both", "translate": [2, -1.2, 0], "scale": [0.5, 1, -1]}],
        "camera": {"eye": [0, 0, 8], "target": [0, 0, 0]},
        "lights": {"default_count": 2, "fixed": [{"kind": "point", "color": [40, 40, 40], "position": [2, 3, 6], "radius": 30},
                            {"kind": "point", "color": [40, 20, 20], "position": [-3, -2, -6], "radius": 30}]},
        "ambient": [0.1, 0.1, 0.1]})");
    Truth truth(file.string(), 2);
    expect_every_path_explained(truth, "mirrored");
    size_t away = 0;  // by more than a smooth normal does at a coarse rim
    for (const auto& s : truth.surfaces()) {
        if (s.covered && s.model == ShadingModel::lambert && glm::dot(s.normal, glm::normalize(s.position)) > 0.1)
            ++away;
    }
    EXPECT_EQ(away, 0U) << "a ball turned inside out shows its outside";
}

struct Fault {
    const char* name;
    const char* scene;
    const char* file;  ///< below shaders/
    const char* right;
    const char* wrong;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

const Fault kFaults[] = {
    {"visibility_twice", "spheres", "lib/brdf.glsl", "0.5 / (lambda_v", "1.0 / (lambda_v"},
    {"missing_pi_ggx", "atrium", "lib/brdf.glsl", "s.base_color * (1.0 / kPi);", "s.base_color;"},
    {"missing_pi_lambert", "cornell", "lib/brdf.glsl", "s.base_color * (1.0 / kPi);", "s.base_color;"},
    {"wrong_normal", "cornell", "lib/brdf.glsl", "n_dot_l = dot(normal, l)", "n_dot_l = dot(v, l)"},
    {"fresnel_power", "spheres", "lib/brdf.glsl", "m2 * m2 * m;", "m2 * m2;"},
    {"lobes_swapped", "spheres", "lib/brdf.glsl", "reflectance * lights.f0 + lights.f90",
     "reflectance * lights.f90 + lights.f0"},
    {"alpha_not_squared", "spheres", "lib/brdf.glsl",
     "max(roughness * roughness, kMinAlpha), roughness * roughness);\n    float alpha2",
     "max(roughness, kMinAlpha), roughness);\n    float alpha2"},
    {"phong_energy", "materials", "lib/brdf.glsl", "(exponent + 8.0)", "(exponent + 2.0)"},
    {"window_once", "cornell", "lib/light.glsl", "window * window", "window"},
    {"distance_once", "cornell", "lib/light.glsl", "max(distance_squared, kMin", "sqrt(distance_squared + kMin"},
    {"spot_once", "materials", "lib/light.glsl", "spot * spot", "spot"},
    {"normal_map_upside_down", "materials", "lib/material.glsl", "cross(normal, tangent.xyz) * tangent.w",
     "cross(tangent.xyz, normal) * tangent.w"},
    {"ambient_lost", "atrium", "lib/shade.glsl", "frame.ambient * s.base_color", "vec3(0.0)"},
};

class PlantedFault : public testing::TestWithParam<Fault> {};
INSTANTIATE_TEST_SUITE_P(Shader, PlantedFault, testing::ValuesIn(kFaults), [](const auto& c) { return c.param.name; });

TEST_P(PlantedFault, IsFound) {
    const Fault& fault = GetParam();
    std::string text = read_file(resource(std::string("shaders/") + fault.file));
    const size_t at = text.find(fault.right);
    ASSERT_NE(at, std::string::npos) << "the shader no longer says: " << fault.right;
    text.replace(at, std::string_view(fault.right).size(), fault.wrong);
    Truth truth(fault.scene, 16, 160, 90);
    const Judgement right = judge(truth, truth.draw("deferred"));
    const Judgement wrong = judge(truth, truth.draw("deferred", {{fault.file, text}}));
    EXPECT_EQ(right.unexplained, 0U) << right.text;
    EXPECT_GT(wrong.unexplained, wrong.pixels / 100) << wrong.text;
}

}  // namespace
}  // namespace lightsweep
