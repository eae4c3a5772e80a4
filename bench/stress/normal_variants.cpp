#include "bench/stress/normal_variants.h"

#include "renderer/base/check.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

const std::vector<Variant>& normal_variants() {
    static const auto variants = [] {
        auto all = shipped_variants();
        std::erase_if(all, [](const Variant& v) { return v.field != "normal"; });
        return all;
    }();
    return variants;
}

// From one value of a channel to the next. Floats are taken at 1, where they are coarsest; and as if they were cut off,
// not rounded, so that half a step here is a whole one of theirs.
double channel_step(const Variant& variant) {
    const gl::Format format = variant.layout.targets.front().format;
    if (const auto grid = channel_grid(format, variant.stored(), 0)) return grid->step;
    return gl::info(format).bits[0] == 16 ? 0x1p-10 : 0x1p-23;
}

}  // namespace

StressAxis normal_encodings() {
    StressAxis axis{.name = "encoding", .values = {}};
    for (const Variant& variant : normal_variants()) axis.values.push_back(variant.name);
    return axis;
}

Variant normal_variant(const StressArm& arm) {
    const auto found = std::ranges::find(normal_variants(), arm.get("encoding"), &Variant::name);
    CHECK_THAT(found != normal_variants().end(), "encoding = {}", arm.get("encoding"));
    return *found;
}

// Each channel is off by half a step s at most. Of three components that is a vector of length s sqrt(3) / 2 beside one
// of length 1. On the octahedron |x| + |y| + |z| = 1, whose faces are 1 / sqrt(3) from the centre, half a step in both
// channels is sqrt(1 + 1 + 4) s / 2 along the face; of its half that faces the eye, turned by 45 degrees to fill the
// square, sqrt(2) s / 2. On the discs |e| is the sine of the angle to the pole (xy_z) or of half of it (spheremap), off
// by s / sqrt(2): most at the rim.
double largest_angle_deg(const Variant& variant, double rounding) {
    const double s = channel_step(variant) + 2.0 * rounding;
    const std::string& encoding = variant.stored().encoding.key;
    const auto of_octahedron = [](double along) { return std::atan(along * std::sqrt(3.0)); };
    double angle = 0.0;
    if (encoding == "xyz" || encoding == "best_fit") {
        angle = std::asin(0.5 * std::sqrt(3.0) * s);
    } else if (encoding == "oct" || encoding == "oct_precise") {
        angle = of_octahedron(0.5 * std::sqrt(6.0) * s);
    } else if (encoding == "hemi_oct") {
        angle = of_octahedron(0.5 * std::sqrt(2.0) * s);
    } else if (encoding == "spheremap") {
        angle = 2.0 * std::acos(1.0 - s / std::sqrt(2.0));
    } else {
        CHECK_THAT(encoding == "xy_z", "no law for the encoding {}", encoding);
        angle = std::acos(1.0 - s / std::sqrt(2.0));
    }
    return glm::degrees(angle);
}

}  // namespace lightsweep
