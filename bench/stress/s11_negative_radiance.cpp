// S11: light that takes light away. A signed format keeps what is below zero until it is shown; an unsigned one ends at
// zero with every store, and a blended sum that passes below zero never comes back to where it should be.
#include "bench/stress/case.h"
#include "bench/stress/hdr_target.h"
#include "bench/stress/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr std::string_view kOrderAxis = "order";
constexpr int kSize = 16;
constexpr double kShading = 1e-4;  // of what shading in 32 bits rounds
const glm::dvec3 kPlace(0.3, -0.2, 1.5);

Light lamp(double intensity) { return point_light(kPlace, 20.0, glm::dvec3(intensity)); }

class Negative {
  public:
    Negative(Workbench& bench, const StressArm& arm)
        : drawing_(bench, arm, plane(), kSize, kSize),
          negative_first_(arm.get(kOrderAxis) == "negative_first"),
          blends_(blends_lights(arm, drawing_)),
          has_sign_(hdr_channel(drawing_).has_sign),
          rounding_(hdr_rounding(arm, drawing_, 2) + kShading) {
        drawing_.set_lights({lamp(1.0)});
        of_unit_ = drawing_.reference();
    }

    // A lamp of 1, and one in the same place of -share.
    StressMeasurement measure(double share) {
        std::vector<Light> lights{lamp(1.0), lamp(-share)};
        if (negative_first_) std::ranges::reverse(lights);
        drawing_.set_lights(lights);
        const Image image = drawing_.draw();
        StressMeasurement found{.bound = rounding_ * std::max(1.0, share), .non_finite = count_non_finite(image)};
        for (size_t i = 0; i < of_unit_.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const double unit = of_unit_[i][c];
                const double stored = image.rgb[3 * i + static_cast<size_t>(c)];
                found.error = std::max(found.error, std::abs(stored - unit * (1.0 - share)) / unit);
            }
        }
        if (!has_sign_) {
            found.law = lost(share);
            found.where = "an unsigned format holds nothing below 0";
        }
        return found;
    }

  private:
    static Scene plane() {
        Scene scene =
            facing_plane({.name = "plane", .model = ShadingModel::lambert, .base_color = {0.9F, 0.6F, 0.3F}}, 4.0, 3.0);
        declare_light_kinds(scene, true, false, false);
        return scene;
    }

    // Of the lamp's light, where every store ends at zero.
    double lost(double share) const {
        if (blends_ && negative_first_) return share;
        return std::max(share - 1.0, 0.0);
    }

    Drawing drawing_;
    bool negative_first_, blends_, has_sign_;
    double rounding_;
    std::vector<glm::dvec3> of_unit_;
};

std::vector<ArmBlock> arms() {
    const std::string path(kPathAxis), layout(kLayoutAxis), hdr(kHdrAxis), order(kOrderAxis);
    ArmBlock all = every_path("float32", "rgba16f");
    all.push_back({order, {"negative_last"}});
    return {all,
            {{path, {"deferred", "deferred_scissor", "forward_multipass", "light_prepass"}},
             {layout, {"float32"}},
             {hdr, {"r11g11b10f"}},
             {order, {"negative_last"}}},
            {{path, {"deferred", "deferred_scissor"}},
             {layout, {"float32"}},
             {hdr, {"rgba16f", "r11g11b10f"}},
             {order, {"negative_first"}}}};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto negative = std::make_shared<Negative>(bench, arm);
    return [negative](double share) { return negative->measure(share); };
}

}  // namespace

extern const StressCase stress_negative_radiance;
const StressCase stress_negative_radiance{
    .id = "S11",
    .summary = "a light of negative intensity beside a positive one",
    .measures = "the picture against the exact difference, over the positive light's radiance",
    .unit = "rel",
    .bound = 0.0,
    .bound_source = "the format's steps for each store, and 1e-4 of 32-bit shading, of the larger light",
    .failure = "wrong colours where lights cancel, other ones with the lights in another order",
    .parameter = StressParameter{.name = "negative over positive", .unit = "", .easy = 0.1, .hard = 10.0, .steps = 7},
    .law_factor = 1.2,
    .law_floor = 0.2,
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
