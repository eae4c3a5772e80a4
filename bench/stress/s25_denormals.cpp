// S25: radiance below the smallest normal number, where formats have fewer bits or flush to zero, and zeros with a
// sign.
#include "bench/stress/case.h"
#include "bench/stress/hdr_target.h"
#include "bench/stress/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr int kSize = 16;
constexpr size_t kLights = 2;
constexpr double kShading = 1e-4;  // of what shading in 32 bits rounds

// The green of all that is lit is -0.
std::vector<Light> lights_of(double intensity) {
    const glm::dvec3 color(intensity, -0.0, intensity);
    return {point_light({0.4, 0.1, 1.0}, 20.0, 0.5 * color), point_light({-0.4, 0.2, 1.2}, 20.0, 0.5 * color)};
}

class Denormals {
  public:
    Denormals(Workbench& bench, const StressArm& arm)
        : drawing_(bench, arm, plane(), kSize, kSize),
          smallest_normal_(hdr_channel(drawing_).smallest_normal),
          rounding_(hdr_rounding(arm, drawing_, kLights) + kShading) {
        drawing_.set_lights(lights_of(1.0));
        of_unit_ = drawing_.reference();
        for (const glm::dvec3& pixel : of_unit_) brightest_ = std::max({brightest_, pixel.r, pixel.b});
    }

    StressMeasurement measure(double radiance) {
        const double intensity = radiance / brightest_;
        drawing_.set_lights(lights_of(intensity));
        const Image image = drawing_.draw();
        StressMeasurement found{.non_finite = count_non_finite(image)};
        for (size_t i = 0; i < of_unit_.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const double exact = intensity * of_unit_[i][c];
                const double stored = image.rgb[3 * i + static_cast<size_t>(c)];
                const double allowed = rounding_ * std::abs(exact) + smallest_normal_;
                found.error = std::max(found.error, std::abs(stored - exact) / allowed);
            }
        }
        return found;
    }

  private:
    static Scene plane() {
        Scene scene = facing_plane({.name = "plane", .base_color = {0.9F, 0.6F, 0.3F}, .roughness = 0.5F}, 4.0, 3.0);
        declare_light_kinds(scene, true, false, false);
        return scene;
    }

    Drawing drawing_;
    double smallest_normal_, rounding_;
    std::vector<glm::dvec3> of_unit_;  // under lights of intensity 1
    double brightest_ = 0.0;
};

std::vector<ArmBlock> arms() {
    return {every_path(),
            {{std::string(kPathAxis), {"deferred", "deferred_scissor", "light_prepass"}},
             {std::string(kLayoutAxis), {"float32"}},
             {std::string(kHdrAxis), {"rgba16f", "r11g11b10f"}}}};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto denormals = std::make_shared<Denormals>(bench, arm);
    return [denormals](double radiance) { return denormals->measure(radiance); };
}

}  // namespace

extern const StressCase stress_denormals;
const StressCase stress_denormals{
    .id = "S25",
    .summary = "radiance down to denormals, and -0",
    .measures = "the picture against exact radiance, over the smallest normal number and the format's rounding",
    .unit = "rel",
    .bound = 1.0,
    .bound_source = "flushed to zero, what is below the smallest normal number is off by less than it",
    .failure = "NaN where 0 / 0 was computed of what was flushed; speckles in the dark",
    .parameter = StressParameter{.name = "radiance", .unit = "", .easy = 1e-2, .hard = 1e-44, .steps = 9},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
