// S2: perfect mirrors, and surfaces whose roughness is lost on the way through the layout.
#include "bench/stress/case.h"
#include "bench/stress/mirror_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <vector>

namespace lightsweep {
namespace {

constexpr double kClamp = 0.002;  // of alpha, in shaders and reference
constexpr double kRoundings = 0x1p-18;
constexpr int kSize = 33;  // odd: one pixel centre sees the mirror image itself
// 0, what its square underflows to, what 8 bits round to 0 and what they round to 1 / 255.
constexpr float kRoughness[] = {0.0F, 1e-20F, 0.0015F, 0.0025F};

std::vector<MirrorPlane> white_mirrors() {
    std::vector<MirrorPlane> planes;
    for (const float roughness : kRoughness) {
        const Material metal{.name = "metal", .roughness = roughness, .metallic = 1.0F};
        const Material gloss{.name = "gloss",
                             .model = ShadingModel::blinn_phong,
                             .base_color = glm::vec3(0.0F),
                             .roughness = roughness,
                             .specular = glm::vec3(1.0F)};
        for (const Material& material : {metal, gloss}) planes.push_back({material, 4.0 * kClamp});
    }
    return planes;
}

// Of a white mirror with the clamped alpha under a light of unit intensity, where normal, view and light are one
// direction. GGX: D = 1 / pi a^2, masking 1/4. Blinn-Phong: (e + 8) / 8 pi, e = 2 / a^2 - 2.
double clamped_peak(ShadingModel model) {
    const double irradiance = 1.0 / (kMirrorLightHeight * kMirrorLightHeight);
    const double alpha2 = kClamp * kClamp;
    const double lobe = model == ShadingModel::ggx ? 0.25 / alpha2 : (2.0 / alpha2 + 6.0) / 8.0;
    return irradiance * lobe * std::numbers::inv_pi;
}

std::vector<ArmBlock> arms() {
    std::vector<ArmBlock> blocks{every_path(), every_layout()};
    for (ArmBlock& block : blocks) block.push_back({std::string(kGuardsAxis), {"on"}});
    return blocks;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto planes = white_mirrors();
    const auto drawing = std::make_shared<Drawing>(bench, arm, mirror_planes(planes), kSize, kSize);
    // A surface that a layout stores nearer to the light is lit more: twice, by the square of the distance.
    const double nearer = position_error(drawing->arm().setup().layout) / kMirrorLightHeight;
    return [planes, drawing, bound = kRoundings + 2.0 * nearer](double) {
        StressMeasurement found{.bound = bound};
        for (size_t i = 0; i < planes.size(); ++i) {
            drawing->set_camera(mirror_camera(planes, i));
            drawing->set_lights({mirror_light(i, 0.0)});
            const Image image = drawing->draw();
            const int64_t non_finite = count_non_finite(image);
            const Material& material = planes[i].material;
            const double peak = *std::ranges::max_element(image.rgb) / clamped_peak(material.model);
            // Packed layouts may blunt a highlight, but not put it out.
            const double error = peak > 0.0 ? peak - 1.0 : 1.0;
            if (non_finite == 0 && !(error > found.error)) continue;
            found.non_finite += non_finite;
            found.error = std::max(found.error, error);
            found.where = fmt::format("{} of roughness {}", material.name, material.roughness);
        }
        return found;
    };
}

}  // namespace

extern const StressCase stress_zero_roughness;
const StressCase stress_zero_roughness{
    .id = "S2",
    .summary = "roughness 0, and roughness that storing makes 0",
    .measures =
        "how far the brightest pixel is above the peak that the clamp on alpha allows, of that peak; 1 where it is "
        "black",
    .unit = "rel",
    .bound = kRoundings,
    .bound_source =
        "64 roundings of 2^-24: alpha^4 takes 8, the rest of the lobe and of the light fewer than 56; and what the "
        "layout's error of positions adds to the inverse square",
    .failure = "black, white or flashing pixels in the middle of a highlight: 0 / 0, or a peak of any height",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
