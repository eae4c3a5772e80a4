// S7: lights on a surface, just above it, just below it, and many at one place.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace lightsweep {
namespace {

constexpr int kSize = 33;  // odd: one pixel centre sees the very point below the light
constexpr size_t kTogether = 16;
constexpr float kAlbedo = 0.5F;
constexpr double kLeastCertain = 1e-3;  // below it, rounded positions may be on the other side of a light
const glm::dvec3 kColor(1.0, 0.6, 0.3);

// Radiance that no lobe of this material passes under a light of unit intensity: the distance counts as 0.01 at least,
// and a rough surface (alpha 1) that is seen from above reflects no more than 1 / pi besides its albedo's.
constexpr double kCap = 1e4 * (kAlbedo + 1.0) * std::numbers::inv_pi;

// By how much the ratios of the channels differ from the light's.
double hue_error(const Image& image) {
    double error = 0.0;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const float* rgb = &image.rgb[3 * i];
        if (!(rgb[0] > 0.0F)) continue;
        for (int c = 1; c < 3; ++c) {
            error = std::max(error, std::abs(rgb[c] * kColor[0] / (rgb[0] * kColor[c]) - 1.0));
        }
    }
    return error;
}

double excess_over_cap(const Image& image, double lights) {
    return std::max(0.0, *std::ranges::max_element(image.rgb) / (lights * kCap) - 1.0);
}

// Of many lights at one place: by how much their sum is not the one times their number.
double sum_error(const Image& one, const Image& all) {
    double error = 0.0;
    for (size_t i = 0; i < one.rgb.size(); ++i) {
        const double right = static_cast<double>(kTogether) * one.rgb[i];
        if (right > 0.0) error = std::max(error, std::abs(all.rgb[i] - right) / right);
    }
    return error;
}

std::vector<ArmBlock> arms() {
    ArmBlock block = every_path();
    block.push_back({std::string(kGuardsAxis), {"on"}});
    return {block};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    Scene scene = facing_plane({.name = "plane", .base_color = glm::vec3(kAlbedo), .roughness = 1.0F}, 3.0, 2.0);
    declare_light_kinds(scene, true, false, false);
    const auto drawing = std::make_shared<Drawing>(bench, arm, std::move(scene), kSize, kSize);
    return [drawing](double distance) {
        StressMeasurement found;
        const auto note = [&](double error, const char* what) {
            if (!(error > found.error)) return;
            found.error = error;
            found.where = what;
        };
        const auto draw = [&](double height, size_t count) {
            drawing->set_lights(std::vector<Light>(count, point_light({0.0, 0.0, height}, 10.0, kColor)));
            Image image = drawing->draw();
            found.non_finite += count_non_finite(image);
            note(hue_error(image), "hue");
            note(excess_over_cap(image, static_cast<double>(count)), "cap");
            return image;
        };
        draw(0.0, 1);
        const Image below = draw(-distance, 1);
        if (distance >= kLeastCertain) note(*std::ranges::max_element(below.rgb), "lit from below");
        const Image one = draw(distance, 1);
        if (distance >= kLeastCertain && !(one.pixel(kSize / 2, kSize / 2)[0] > 0.0F)) note(1.0, "black below a light");
        note(sum_error(one, draw(distance, kTogether)), "lights at one place");
        return found;
    };
}

}  // namespace

extern const StressCase stress_light_on_surface;
const StressCase stress_light_on_surface{
    .id = "S7",
    .summary = "a light on a surface, near it on both sides, and 16 at one place",
    .measures = "the ratios of the channels, the excess over the cap, the sum of equal lights: the worst",
    .unit = "rel",
    .bound = 0x1p-18,
    .bound_source = "64 roundings of 2^-24: 16 additions, and fewer than 20 steps for each channel",
    .failure = "black, white or wrongly coloured dots where lights touch surfaces",
    .parameter =
        StressParameter{.name = "distance from the surface", .unit = "units", .easy = 1.0, .hard = 1e-6, .steps = 7},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
