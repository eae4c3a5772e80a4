// S1: highlights as narrow as roughness makes them, and as narrow as the clamp on alpha leaves them.
#include "bench/stress/case.h"
#include "bench/stress/mirror_planes.h"
#include "bench/stress/normal_variants.h"
#include "bench/stress/stored_surfaces.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr double kEasy = 0.5, kHard = 0.0005;  // of alpha
constexpr int kPlanes = 145;                   // steps of 4.9 %: no larger than a breakdown is told to
constexpr double kClamp = 0.002;               // of alpha, in shaders and reference
constexpr double kDarkest = 1e-3;              // of the peak: where the lobe ends
constexpr int kSize = 64;
// Of layouts that pack: what the eye just sees of a difference in brightness (Weber's fraction).
constexpr double kVisible = 0.02;

double alpha_of(int plane) { return kEasy * std::pow(kHard / kEasy, plane / (kPlanes - 1.0)); }

size_t plane_of(double alpha) {
    return static_cast<size_t>(std::lround((kPlanes - 1) * std::log(alpha / kEasy) / std::log(kHard / kEasy)));
}

// Four times as wide as the lobe, in tangents of the half vector's angle. The lobe alone: no diffuse part.
std::vector<MirrorPlane> planes_by_alpha(ShadingModel model) {
    Material material{.name = "mirror", .model = model};
    if (model == ShadingModel::ggx) {
        material.metallic = 1.0F;
    } else {
        material.base_color = glm::vec3(0.0F);
        material.specular = glm::vec3(1.0F);
    }
    std::vector<MirrorPlane> planes;
    for (int i = 0; i < kPlanes; ++i) {
        const double alpha = alpha_of(i);
        material.roughness = static_cast<float>(std::sqrt(alpha));
        planes.push_back({material, std::min(0.5, 4.0 * std::max(alpha, kClamp))});
    }
    return planes;
}

// What the layout's encoding turns a normal by at most, and arithmetic besides.
double most_turned_deg(const Layout& layout) {
    const Field normal = Field::normal;
    const Variant alone{.name = layout.key, .field = "normal", .layout = keep_fields(layout, std::span(&normal, 1))};
    return largest_angle_deg(alone, 0x1p-18);
}

std::vector<ArmBlock> arms() {
    ArmBlock phong = every_path();
    phong[0].values = {"forward", "deferred"};
    phong.push_back({"model", {"blinn_phong"}});
    std::vector<ArmBlock> blocks{every_path(), every_layout(), phong};
    for (ArmBlock& block : blocks) block.push_back({std::string(kGuardsAxis), {"on"}});
    return blocks;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto planes = planes_by_alpha(arm.get("model").empty() ? ShadingModel::ggx : ShadingModel::blinn_phong);
    const auto drawing = std::make_shared<Drawing>(bench, arm, mirror_planes(planes), kSize, kSize);
    const std::optional<double> most_turned =
        packs(arm) ? std::optional(most_turned_deg(drawing->arm().setup().layout)) : std::nullopt;
    return [planes, drawing, most_turned](double alpha) {
        const size_t plane = plane_of(alpha);
        drawing->set_camera(mirror_camera(planes, plane));
        drawing->set_lights({mirror_light(plane, 0.6 * planes[plane].half_view)});
        const Image image = drawing->draw();
        const auto surfaces = drawing->surfaces();
        const auto exact = drawing->reference(surfaces);
        double peak = 0.0;
        for (const glm::dvec3& pixel : exact) peak = std::max(peak, pixel.r);
        const PictureErrors errors = picture_errors(exact, image, kDarkest * peak);
        StressMeasurement found{.error = errors.p999, .non_finite = errors.non_finite, .where = errors.where()};
        if (!most_turned) return found;
        found.bound = kVisible;
        if (errors.p999 > kVisible) {
            const StoredSurfaces stored = stored_surfaces(*drawing, surfaces);
            const Image right = to_image(drawing->reference(stored.surfaces), kSize, kSize);
            // A normal that is turned by more was not stored as the encoding says: no law excuses it.
            if (stored.normal_deg <= *most_turned) found.law = picture_errors(exact, right, kDarkest * peak).p999;
            found.where = fmt::format("stored are the normal {:.2g} degrees and alpha {:.2g} % off", stored.normal_deg,
                                      100.0 * stored.alpha);
        }
        return found;
    };
}

}  // namespace

extern const StressCase stress_sharp_ggx;
const StressCase stress_sharp_ggx{
    .id = "S1",
    .summary = "GGX highlights, and Blinn-Phong's as sharp, down to alpha 0.002 and below it, where alpha is clamped",
    .measures = "p99.9 of the error over the lobe's pixels (those above a thousandth of its peak), of the exact value",
    .unit = "rel",
    .bound = 1e-3,
    .bound_source =
        "a half vector that is off by 4 roundings of 2^-24 moves D by 2 / alpha times that, 2.4e-4 at alpha 0.002; of "
        "layouts that pack: 0.02, Weber's fraction; law: exact shading of what the layout stores, as long as its "
        "normal is within the encoding's largest angle",
    .failure = "rings and speckles in the highlight: 1 - (n.h)^2, or the logarithm of n.h, has no digits left",
    .parameter = StressParameter{.name = "alpha", .unit = "", .easy = kEasy, .hard = kHard},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
