// S14: distances through a depth buffer and back, by format, convention, clip range and planes. A point in each pixel
// is drawn at a known distance, its depth stored, and the distance rebuilt as shading does it.
#include "bench/encodings/round_trip.h"
#include "bench/stress/case.h"
#include "bench/stress/depth_law.h"
#include "renderer/base/check.h"
#include "renderer/base/names.h"
#include "renderer/base/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

namespace lightsweep {
namespace {

constexpr std::string_view kClipAxis = "clip", kPlanesAxis = "planes";
const std::vector<std::string> kClips{"zero_to_one", "minus_one_to_one"};

constexpr int kSide = 64;
constexpr uint64_t kSeed = 14;
// Half of the width within which a parameter is one: a breakdown is told to 5 %.
constexpr double kWindow = 0.025;
// Where a step of depth is a quarter of the distance, the hyperbola makes of a little error any error: no law holds.
constexpr double kLastLaw = 0.25;
// Samples spread over as many errors of depth at least: then some of them are rounded by nearly half a step.
constexpr double kErrorsAcross = 4.0;

Variant variant_of(const StressArm& arm) {
    const auto planes = split(arm.get(kPlanesAxis), '-');
    const Layout layout = stress_setup(arm, {}).layout;
    Variant variant{.name = arm.name(), .field = "depth", .layout = {}};
    variant.layout.depth = layout.depth;
    variant.layout.convention = layout.convention;
    variant.clip = static_cast<gl::ClipDepth>(std::ranges::find(kClips, arm.get(kClipAxis)) - kClips.begin());
    variant.near_distance = std::stod(planes.at(0));
    variant.far_distance = std::stod(planes.at(1));
    return variant;
}

class DepthTrial {
  public:
    explicit DepthTrial(const Variant& variant)
        : law_(variant.layout.depth, variant.layout.convention, variant.clip, variant.near_distance,
               variant.far_distance),
          near_(variant.near_distance),
          far_(variant.far_distance),
          trip_(variant, kSide, kSide),
          samples_(make_float_texture(kSide, kSide, "distances")),
          decoded_(make_float_texture(kSide, kSide, "decoded distances")) {
        const gl::Texture* const target = &decoded_;
        framebuffer_ = gl::Framebuffer(std::span(&target, 1), nullptr, "decoded distances");
    }

    StressMeasurement operator()(double near_distances) {
        const std::vector<glm::vec4> sent = samples_around(std::min(near_ * near_distances, far_));
        samples_.upload_floats({&sent.front().x, sent.size() * 4});
        trip_.encode(samples_);
        trip_.decode(framebuffer_);
        const std::vector<glm::vec4> back = read_pixels(decoded_);
        StressMeasurement found;
        double law = 0.0;
        bool between_planes = true;
        for (size_t i = 0; i < sent.size(); ++i) {
            const double z = static_cast<double>(sent[i].x), rebuilt = static_cast<double>(back[i].x);
            law = std::max(law, law_.distance_error(z));
            between_planes = between_planes && rebuilt >= near_ * (1.0 - kWindow) && rebuilt <= far_ * (1.0 + kWindow);
            if (!std::isfinite(rebuilt)) {
                ++found.non_finite;
            } else if (const double error = std::abs(rebuilt - z) / z; error > found.error) {
                found.error = error;
                found.where = fmt::format("at the distance {:.4g} came {:.4g}", z, rebuilt);
            }
        }
        if (law <= kLastLaw) {
            found.law = law;
        } else if (between_planes) {
            found.limit = "one step of depth is as wide as what is left to the far plane";
        }
        return found;
    }

  private:
    // Even in depth, so that what the format rounds off is even too.
    std::vector<glm::vec4> samples_around(double z) const {
        const double depth = law_.depth(z);
        const double width = std::max(std::abs(law_.depth(z * (1.0 + kWindow)) - law_.depth(z * (1.0 - kWindow))),
                                      kErrorsAcross * law_.depth_error(z));
        Random random(kSeed);
        std::vector<glm::vec4> samples(static_cast<size_t>(kSide) * kSide);
        for (glm::vec4& sample : samples) {
            const double at = law_.distance(depth + width * random.uniform(-1.0, 1.0));
            sample = glm::vec4(static_cast<float>(std::clamp(at, near_, far_)), 0.0F, 0.0F, 0.0F);
        }
        return samples;
    }

    DepthLaw law_;
    double near_, far_;
    RoundTrip trip_;
    gl::Texture samples_, decoded_;
    gl::Framebuffer framebuffer_;
};

std::vector<ArmBlock> arms() {
    return {{{std::string(kDepthAxis), kStressDepths},
             {std::string(kClipAxis), kClips},
             {std::string(kPlanesAxis), {"0.1-1000"}}},
            {{std::string(kDepthAxis), kStressDepths},
             {std::string(kClipAxis), {"zero_to_one"}},
             {std::string(kPlanesAxis), {"1-100", "0.001-100", "0.001-1e7"}}}};
}

StressTrial begin(Workbench&, const StressArm& arm) {
    const auto trial = std::make_shared<DepthTrial>(variant_of(arm));
    return [trial](double near_distances) { return (*trial)(near_distances); };
}

}  // namespace

extern const StressCase stress_depth_formats{
    .id = "S14",
    .summary = "distances stored as depth and rebuilt, by format, convention, clip range, near and far",
    .measures = "largest error of the rebuilt distance around one distance, over that distance",
    .unit = "rel",
    .bound = 0x1p-10,
    .bound_source = "what a position stored in half floats loses: a step of 2^-10",
    .failure = "lights and shadows that swim on distant surfaces; bands across them",
    .parameter = StressParameter{.name = "distance", .unit = "near distances", .easy = 5.0, .hard = 1e8, .steps = 9},
    .law_factor = 2.0,
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
