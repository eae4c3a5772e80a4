#include "bench/encodings/field_kind.h"
#include "bench/encodings/round_trip.h"
#include "bench/stress/case.h"
#include "bench/stress/normal_variants.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

constexpr int kSide = 256;
// Eight roundings of 2^-23 on the way to a channel's value, most of them where normals turn into a pixel's own axes.
constexpr double kRounding = 0x1p-20;

// Where maps fold, end or divide: the axes with zeros of both signs, the plane z = 0 and a hair above and below it, the
// poles and a hair beside them, the middles of edges and octants.
std::vector<glm::vec3> special_normals() {
    std::vector<glm::vec3> normals;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0F, -1.0F}) {
            for (const float zero : {0.0F, -0.0F, 1e-30F, -1e-30F, 1e-7F, -1e-7F}) {
                glm::vec3 normal(zero);
                normal[axis] = sign;
                normals.push_back(normal);
            }
        }
    }
    for (int i = 0; i < 32; ++i) {
        const double angle = i * std::numbers::pi / 16.0;
        for (const double z : {0.0, -0.0, 1e-7, -1e-7, 1e-3, -1e-3}) {
            const double across = std::sqrt(1.0 - z * z);
            normals.emplace_back(glm::dvec3(across * std::cos(angle), across * std::sin(angle), z));
        }
    }
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 signs(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
        normals.emplace_back(glm::normalize(signs));
        for (const glm::dvec3& edge : {glm::dvec3(0, 1, 1), glm::dvec3(1, 0, 1), glm::dvec3(1, 1, 0)}) {
            normals.emplace_back(glm::normalize(signs * edge));
        }
        normals.emplace_back(glm::normalize(signs * glm::dvec3(1e-4, 1e-4, 1.0)));
    }
    return normals;
}

// Hemispheres hold what faces the eye as the pixel sees it: each normal, in the pixel's own axes and in the world's.
void place_specials(const Variant& variant, std::vector<glm::vec4>& samples) {
    const auto normals = special_normals();
    const shared::FrameData frame = probe_constants(variant, kSide, kSide);
    for (size_t i = 0; i < samples.size(); ++i) {
        glm::dvec3 normal = normals[i % normals.size()];
        if (variant.hemisphere()) {
            const glm::dvec2 pixel(i % kSide, i / kSide);
            const glm::dvec2 ndc =
                (pixel + 0.5) * glm::dvec2(frame.pixel_to_ndc_x, frame.pixel_to_ndc_y) - glm::dvec2(1.0);
            const glm::dvec3 up(frame.ray_up);
            const glm::dvec3 z =
                -glm::normalize(ndc.x * glm::dvec3(frame.ray_right) + ndc.y * up + glm::dvec3(frame.ray_forward));
            const glm::dvec3 x = glm::normalize(glm::cross(up, z));
            const bool own_axes = i / normals.size() % 2 == 0;
            if (own_axes) normal = glm::dmat3(x, glm::cross(z, x), z) * normal;
            if (glm::dot(normal, z) < 0.0) normal = -normal;
        }
        samples[i] = glm::vec4(glm::vec3(normal), 0.0F);
    }
}

StressMeasurement compare(const Variant& variant, const std::vector<glm::vec4>& sent,
                          const std::vector<glm::vec4>& back) {
    const FieldKind& kind = field_kind("normal");
    StressMeasurement found{.law = largest_angle_deg(variant), .bound = largest_angle_deg(variant, kRounding)};
    for (size_t i = 0; i < sent.size(); ++i) {
        const double angle = kind.error(glm::dvec4(sent[i]), glm::dvec4(back[i])).front();
        if (!std::isfinite(angle)) {
            ++found.non_finite;
        } else if (angle > found.error) {
            found.error = angle;
            found.where = fmt::format("the normal ({:.7g}, {:.7g}, {:.7g})", sent[i].x, sent[i].y, sent[i].z);
        }
    }
    return found;
}

std::vector<ArmBlock> arms() { return {{normal_encodings(), {"normals", {"special", "random"}}}}; }

StressTrial begin(Workbench&, const StressArm& arm) {
    const Variant variant = normal_variant(arm);
    auto samples = make_samples(variant, kSide, kSide);
    if (arm.get("normals") == "special") place_specials(variant, samples);
    const auto back = round_trip(variant, samples, kSide, kSide);
    const StressMeasurement found = compare(variant, samples, back);
    return [found](double) { return found; };
}

}  // namespace

extern const StressCase stress_special_normals{
    .id = "S23",
    .summary = "normals on the axes, the fold and the poles, with zeros of both signs, through every encoding",
    .measures = "angle between a normal and what comes back of it",
    .unit = "deg",
    .bound_source = "half a step of each channel, through the encoding's map, and eight roundings of 2^-23",
    .failure = "seams and sparkles where a surface faces along an axis",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
