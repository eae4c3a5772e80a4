// S10: radiance beyond what the HDR target holds, up to where 32-bit floats end.
#include "bench/stress/case.h"
#include "bench/stress/hdr_target.h"
#include "bench/stress/test_scenes.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace lightsweep {
namespace {

constexpr int kSize = 16;
constexpr double kEyeDistance = 3.0;
constexpr size_t kLights = 4;
constexpr double kBrightest = 3e38;  // still a number in 32 bits; the irradiance that it takes is not
constexpr double kShading = 1e-3;    // a surface 3 away is rounded by 2^-22; lights are 2^-6.5 from it
constexpr double kMostLight = 1e38;  // of lib/brdf.glsl

// The centre of the pixel beside the middle.
const double kPixelX = kEyeDistance * std::tan(glm::radians(30.0)) / kSize;

// One channel is not reflected at all: infinite light times zero would be no number.
Scene plane() {
    Scene scene = facing_plane({.name = "plane", .model = ShadingModel::lambert, .base_color = {1.0F, 0.5F, 0.0F}}, 4.0,
                               kEyeDistance);
    declare_light_kinds(scene, true, false, false);
    return scene;
}

// Right above a pixel: their light overflows there before their intensity does.
std::vector<Light> lights_of(double intensity) {
    return std::vector<Light>(kLights, point_light({kPixelX, kPixelX, 0.011}, 50.0, glm::dvec3(intensity)));
}

double largest(const std::vector<glm::dvec3>& radiance) {
    double most = 0.0;
    for (const glm::dvec3& pixel : radiance) most = std::max({most, pixel.r, pixel.g, pixel.b});
    return most;
}

// What the arm can hold: of its HDR target, of sums in 32 bits, of light buffers before the material's 1 / pi.
double largest_radiance(const StressArm& arm, const Drawing& drawing) {
    const double of_sums = kMostLight * std::numbers::inv_pi;
    const double of_target = hdr_channel(drawing).largest;
    const bool light_buffers = arm.get(kPathAxis) == "light_prepass";
    return std::min(light_buffers ? of_target * std::numbers::inv_pi : of_target, of_sums);
}

class Overflow {
  public:
    Overflow(Workbench& bench, const StressArm& arm)
        : drawing_(bench, arm, plane(), kSize, kSize),
          holds_(largest_radiance(arm, drawing_)),
          what_ends_(holds_ < hdr_channel(drawing_).largest && arm.get(kHdrAxis) == "rgba32f"
                         ? "sums of lights are cut off"
                         : "ends"),
          bound_(hdr_rounding(arm, drawing_, kLights) + kShading),
          surfaces_(drawing_.surfaces()) {
        drawing_.set_lights(lights_of(1.0));
        of_unit_ = largest(drawing_.reference(surfaces_));
    }

    StressMeasurement measure(double radiance) {
        drawing_.set_lights(lights_of(radiance / of_unit_));
        const std::vector<glm::dvec3> exact = drawing_.reference(surfaces_);
        const Image hdr = drawing_.draw();
        StressMeasurement found{.bound = bound_, .non_finite = count_nan(hdr)};
        if (const int64_t wrong = badly_shown(exact); wrong > 0) {
            found.error = static_cast<double>(wrong);
            found.where = fmt::format("{} display values are wrong", wrong);
            return found;
        }
        for (size_t i = 0; i < exact.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // What has become infinite is off by as much as the largest number would be.
                const double stored = std::min<double>(hdr.rgb[3 * i + static_cast<size_t>(c)], holds_);
                found.error = std::max(found.error, std::abs(stored - exact[i][c]) / radiance);
            }
        }
        if (radiance > holds_) found.limit = fmt::format("{} at {:.5g}, and is shown white beyond", what_ends_, holds_);
        return found;
    }

  private:
    static int64_t count_nan(const Image& image) {
        return std::ranges::count_if(image.rgb, [](float v) { return std::isnan(v); });
    }

    // Values of the display that are more than a step of 8 bits from what the bound allows.
    int64_t badly_shown(const std::vector<glm::dvec3>& exact) const {
        const Image least = shown(exact, 1.0 - bound_), most = shown(exact, 1.0 + bound_);
        const Image display = drawing_.display();
        constexpr float kStep = 1.0F / 255.0F;
        int64_t count = 0;
        for (size_t i = 0; i < display.rgb.size(); ++i) {
            if (!(display.rgb[i] >= least.rgb[i] - kStep && display.rgb[i] <= most.rgb[i] + kStep)) ++count;
        }
        return count;
    }

    static Image shown(std::vector<glm::dvec3> radiance, double factor) {
        for (glm::dvec3& pixel : radiance) pixel *= factor;
        return tone_mapped(to_image(radiance, kSize, kSize));
    }

    Drawing drawing_;
    double holds_;
    std::string_view what_ends_;
    double bound_;
    std::vector<ReferenceSurface> surfaces_;
    double of_unit_ = 1.0;  // radiance of the brightest pixel under lights of intensity 1
};

std::vector<ArmBlock> arms() {
    const std::vector<std::string> kinds{"forward_multipass", "deferred", "deferred_volumes", "light_prepass"};
    return {every_path("float32", "rgba16f"),
            {{std::string(kPathAxis), kinds},
             {std::string(kLayoutAxis), {"float32"}},
             {std::string(kHdrAxis), {"r11g11b10f", "rgba32f"}}}};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto overflow = std::make_shared<Overflow>(bench, arm);
    return [overflow](double radiance) { return overflow->measure(radiance); };
}

}  // namespace

extern const StressCase stress_hdr_overflow;
const StressCase stress_hdr_overflow{
    .id = "S10",
    .summary = "radiance beyond the HDR target's largest number",
    .measures =
        "the HDR picture against exact radiance, over the brightest pixel's; the display must be white, not NaN",
    .unit = "rel",
    .bound = 0.0,
    .bound_source = "the format's steps for each store, and 1e-3 of 32-bit shading",
    .failure = "black pixels in the middle of highlights",
    .parameter = StressParameter{.name = "radiance", .unit = "", .easy = 1e3, .hard = kBrightest, .steps = 10},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
