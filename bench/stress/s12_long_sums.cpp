// S12: up to ten thousand lights on one surface, equally bright or 1 to 10^4, in orders. What is added up is each light
// drawn alone by the same path into 32-bit floats; their sum in double precision is exact.
#include "bench/plan/cell.h"
#include "bench/stress/case.h"
#include "bench/stress/hdr_target.h"
#include "bench/stress/test_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr std::string_view kOrderAxis = "order";
const std::vector<std::string> kOrders{"equal", "rising", "falling", "shuffled"};

constexpr int kMostLights = 10'000;
constexpr int kSize = 4, kX = 2, kY = 1;  // of the picture, and the pixel that is looked at
constexpr int kLevels = 16;               // of brightness, evenly spread in its logarithm
constexpr double kSpread = 1e4;           // the brightest over the faintest
constexpr double kFaintest = 0.0125;      // reflects 1e-3, far from where half floats end at either side
constexpr uint64_t kSeed = 12;

// Blended: half a step of 8 bits. Registers: (N - 1) u, u = 2^-24 (Higham 2002, "Accuracy and Stability of Numerical
// Algorithms", 4.2); or, compensated, 2 u whatever N is; and the products' roundings.
constexpr double kDisplayBound = 1.0 / 510.0;
constexpr double kProductsBound = 0x1p-21;

double register_bound(bool compensated, double lights) {
    return kProductsBound + (compensated ? 0.0 : (lights - 1.0) * 0x1p-24);
}

std::vector<Light> lights_of(const std::vector<int>& levels) {
    std::vector<Light> lights;
    for (const int level : levels) {
        const double intensity = kFaintest * std::pow(kSpread, level / (kLevels - 1.0));
        lights.push_back(point_light({0.0, 0.0, 2.0}, 100.0, glm::dvec3(intensity)));
    }
    return lights;
}

class LongSum {
  public:
    LongSum(Workbench& bench, const StressArm& arm)
        : drawing_(bench, arm, plane(), kSize, kSize), order_(arm.get(kOrderAxis, "equal")) {
        const gl::Format format = drawing_.arm().setup().hdr;
        channel_ = coarsest_channel_index(format);
        mantissa_bits_ = hdr_channel(drawing_).mantissa_bits;
        if (blends_lights(arm, drawing_)) {
            blend_ = probe_rounding(format).blend;
        }
        compensated_ = arm.get(kSumsAxis) == kCompensatedSums;
        if (format != gl::Format::RGBA32F) stored_ = hdr_channel(drawing_).epsilon();
        draw_each_alone(bench, arm);
    }

    StressMeasurement measure(double parameter) {
        const std::vector<int> levels = levels_of(static_cast<int>(parameter));
        std::vector<double> parts;
        double exact = 0.0;
        for (const int level : levels) {
            parts.push_back(alone_[static_cast<size_t>(level)]);
            exact += parts.back();
        }
        drawing_.set_lights(lights_of(levels));
        const Image image = drawing_.draw();
        const double sum = image.pixel(kX, kY)[channel_];
        StressMeasurement found{.error = std::abs(sum / exact - 1.0),
                                .bound = stored_ + (blend_ ? kDisplayBound : register_bound(compensated_, parameter)),
                                .non_finite = count_non_finite(image),
                                .where = fmt::format("{:.7g} for {:.7g}", sum, exact)};
        if (blend_ && *blend_ != Rounding::other) {
            found.law = std::abs(rounded_sum(parts, mantissa_bits_, *blend_) / exact - 1.0);
        }
        return found;
    }

  private:
    static Scene plane() {
        Scene scene = facing_plane({.name = "plane", .model = ShadingModel::lambert}, 8.0, 4.0);
        declare_light_kinds(scene, true, false, false);
        return scene;
    }

    void draw_each_alone(Workbench& bench, const StressArm& arm) {
        const StressArm exact_arm({{std::string(kPathAxis), arm.get(kPathAxis)}, {std::string(kHdrAxis), "rgba32f"}});
        Drawing single(bench, exact_arm, plane(), kSize, kSize);
        for (int level = 0; level < kLevels; ++level) {
            single.set_lights(lights_of({level}));
            alone_.push_back(single.draw().pixel(kX, kY)[channel_]);
        }
    }

    std::vector<int> levels_of(int count) const {
        std::vector<int> levels;
        for (int i = 0; i < count; ++i) levels.push_back(order_ == "equal" ? 0 : i * kLevels / count);
        if (order_ == "falling") std::ranges::reverse(levels);
        return order_ == "shuffled" ? shuffled(std::move(levels), kSeed) : levels;
    }

    Drawing drawing_;
    std::string order_;
    int channel_ = 0;
    int mantissa_bits_ = 0;
    std::optional<Rounding> blend_;  // of paths that add in the HDR target
    bool compensated_ = false;
    double stored_ = 0.0;        // what storing the sum once rounds off
    std::vector<double> alone_;  // what a light of each level adds
};

std::vector<ArmBlock> arms() {
    const std::string path(kPathAxis), hdr(kHdrAxis), sums(kSumsAxis), order(kOrderAxis);
    const std::vector<std::string> formats{"rgba32f", "rgba16f", "r11g11b10f"};
    return {
        {{path, {"deferred"}}, {hdr, {"rgba32f"}}, {sums, {"plain", kCompensatedSums}}, {order, kOrders}},
        {{path, {"forward", "deferred"}}, {hdr, formats}, {sums, {"plain"}}, {order, {"equal"}}},
        {{path, {"deferred_scissor"}}, {hdr, formats}, {order, kOrders}},
        {{path, {"forward_multipass", "deferred_volumes"}}, {hdr, formats}, {order, {"equal"}}},
        {{path,
          {"forward", "forward_prepass", "forward_tiled", "forward_clustered", "deferred_tiled", "deferred_clustered",
           "visibility"}},
         {hdr, {"rgba32f"}},
         {sums, {"plain", kCompensatedSums}},
         {order, {"equal"}}},
    };
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto sum = std::make_shared<LongSum>(bench, arm);
    return [sum](double parameter) { return sum->measure(parameter); };
}

}  // namespace

extern const StressCase stress_long_sums;
const StressCase stress_long_sums{
    .id = "S12",
    .summary = "1 to 10^4 lights on one pixel, equal or 1 to 10^4, sorted and shuffled",
    .measures = "the picture against the sum of each light drawn alone, in double precision",
    .unit = "rel",
    .bound = kDisplayBound,
    .bound_source =
        "blended: half a step of 8 bits; registers: (N - 1) 2^-24 at N = 10^4 (Higham 2002, 4.2), compensated 2^-21 at "
        "any N; and the format's step, for storing it once",
    .failure = "surfaces under many lights are too dark, and flicker as the list's order changes",
    .parameter =
        StressParameter{.name = "lights", .unit = "", .easy = 1, .hard = kMostLights, .steps = 9, .whole = true},
    .law_factor = 1.2,
    .law_floor = 0x1p-22,
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
