// A scene: geometry, materials, lights, camera. Plain data, no GL. The same file and seed give the same scene.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// How a surface answers light. The values are stored in the G-buffer (2 bits) and read by shaders/lib/brdf.glsl.
enum class ShadingModel : uint32_t {
    ggx = 0,          ///< metallic-roughness microfacet (glTF 2.0, appendix B)
    blinn_phong = 1,  ///< normalised Blinn-Phong; the exponent is 2/alpha^2 - 2 with alpha = roughness^2
    lambert = 2,      ///< diffuse only
};
inline constexpr int kShadingModelCount = 3;
extern const std::vector<std::string> kShadingModelNames;  ///< the keys in scene files, by value

/// 8-bit RGBA texels, row by row from the image's first row (glTF: texture coordinate v = 0).
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    bool srgb = false;  ///< colour: decoded from sRGB when sampled. Normals and roughness are linear.
    std::vector<uint8_t> rgba;
};

inline constexpr int kNoTexture = -1;

/// Factors multiply their textures, as in glTF 2.0.
struct Material {
    std::string name;
    ShadingModel model = ShadingModel::ggx;
    glm::vec3 base_color{1.0F};  ///< linear; the diffuse colour of blinn_phong and lambert
    float roughness = 1.0F;      ///< perceptual, [0, 1]; alpha = roughness^2
    float metallic = 0.0F;       ///< [0, 1]; ggx only
    glm::vec3 specular{0.0F};    ///< linear, [0, 1]; blinn_phong only
    /// blinn_phong: specular = luminance of the base colour times `specular`, as in luminance G-buffers.
    bool specular_from_luminance = false;
    glm::vec3 emissive{0.0F};  ///< linear radiance
    int base_color_texture = kNoTexture;
    int metallic_roughness_texture = kNoTexture;  ///< G roughness, B metallic
    int normal_texture = kNoTexture;              ///< tangent space, +Y up
    int emissive_texture = kNoTexture;
    float normal_scale = 1.0F;
    float alpha_cutoff = 0.0F;  ///< a fragment with alpha below it is discarded; 0: opaque
    bool double_sided = false;  ///< else triangles facing away are not drawn
};

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec4 tangent;  ///< w is the handedness of the bitangent: cross(normal, tangent.xyz) * w
    glm::vec2 uv;
};

struct Bounds {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
    bool empty() const { return low.x > high.x; }
    void include(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    glm::dvec3 center() const { return 0.5 * (low + high); }
    glm::dvec3 size() const { return high - low; }
};

/// A run of triangles with one material; counter-clockwise triangles face the viewer.
struct Mesh {
    std::string name;
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    uint32_t material = 0;
    Bounds bounds;  ///< of the positions, in the mesh's own space
};

struct Instance {
    uint32_t mesh = 0;
    glm::dmat4 transform{1.0};  ///< mesh space to world space; double, so that a far origin loses nothing
};

/// Right-handed, y up, looks down its own -z.
struct Camera {
    glm::dvec3 eye{0.0, 1.0, 5.0};
    glm::dvec3 target{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double fov_y_deg = 60.0;
    double near_distance = 0.1;
    double far_distance = 100.0;
};

enum class LightKind { point, spot, directional };

struct Light {
    LightKind kind = LightKind::point;
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, -1.0, 0.0};  ///< unit; the way the light travels
    glm::dvec3 color{1.0};                 ///< point, spot: intensity (W/sr); directional: irradiance (W/m^2)
    double radius = 1.0;                   ///< the window is exactly zero from here on; unused by directional
    double inner_deg = 20.0;               ///< spot: full intensity within this angle from the axis
    double outer_deg = 30.0;               ///< spot: exactly zero from this angle on
};

/// Where generated lights stand.
enum class Placement { grid, random, surface };

/// A rule that makes the i-th light of an endless sequence. The first n lights are the same whatever n is.
struct LightGenerator {
    Placement placement = Placement::random;
    Bounds bounds;                              ///< grid and random: where; surface: unused
    double height_min = 0.1, height_max = 0.5;  ///< surface: distance from the surface along its normal
    uint64_t seed = 1;
    double radius = 1.0;                        ///< in the fixed regime
    double intensity = 1.0;                     ///< W/sr of the brightest channel at that radius
    double saturation = 0.6;                    ///< 0 white, 1 pure hues
    double spot_share = 0.0;                    ///< share of spots among them, [0, 1]
    double inner_deg = 20.0, outer_deg = 30.0;  ///< of the spots
};

struct LightRig {
    std::vector<Light> fixed;                 ///< written out in the file; the first of the sequence
    std::optional<LightGenerator> generator;  ///< continues the sequence
    int default_count = 1;                    ///< how many when nobody says
    double default_overlap = 0.0;             ///< k of the constant-overlap regime; 0: fixed radius
};

struct Scene {
    std::string key;  ///< its name on the command line, in JSON and in plots
    std::string summary;
    std::string content_hash;  ///< of everything below
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Instance> instances;  ///< drawn in this order
    Camera camera;
    LightRig lights;
    glm::dvec3 ambient{0.0};            ///< constant radiance from everywhere; reflected by the base colour
    glm::dvec3 background{0.0};         ///< radiance where no surface is
    std::vector<std::string> warnings;  ///< what the file asks for that is drawn otherwise; shown in the report

    uint64_t triangle_count() const;  ///< of all instances
    Bounds world_bounds() const;
};

/// Loads a shipped scene by its key, or a user's .json, .gltf or .glb by its path. A glTF file gets a camera that sees
/// all of it and lights in its bounds. Throws InputError with file, place and cure.
Scene load_scene(const std::string& key_or_path);

/// How the radius follows the light count.
struct RadiusRegime {
    double overlap =
        0.0;  ///< > 0: shrink radii so that about this many generated lights reach a surface point; 0: fixed
};

/// The first `count` lights of the scene's sequence: the written ones, then generated ones. In the constant-overlap
/// regime the radius r of generated lights follows `count` (never above the generator's) and their intensity follows
/// r^2, so that the lit level stays. Throws InputError when the scene has fewer written lights than `count` and no
/// generator.
std::vector<Light> make_lights(const Scene& scene, int count, RadiusRegime regime);

}  // namespace lightsweep
