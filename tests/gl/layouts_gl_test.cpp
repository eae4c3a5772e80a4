// What must hold for every layout file: what is read back differs from what was written by no more than its bits
// explain.
//
// The bounds, worked out from the layout's data. s is the step of a channel in its own range: 1 / (2^b - 1) for b bits
// unsigned, 2 / (2^b - 1) for a signed channel in an unsigned format, 1 / (2^(b-1) - 1) signed; 2^-10 (half) or 2^-23
// (float) of the value in float formats. A whole step, not half of one, since some drivers truncate.
//   linear, rgb   s; in sRGB 2.4 / 1.055 s, the curve's steepest slope
//   gamma2, sqrt  c = e^2, so 2 sqrt(c) s + s^2 <= 2 s + s^2
//   ycocg         luma and each chroma off by s of their own: red and blue get all three, chroma halved; then as
//   gamma2.
//                 Holds away from edges: 19 of 20 values. Twice of it, since the missing chroma is a neighbour's.
//   xyz, best_fit each component off by s moves a unit vector by at most sqrt(3) s radians, up to O(s^2)
//   oct           (x, y, 1 - |x| - |y|) is off by at most sqrt(6) s, and at least 1/sqrt(3) long: sqrt(18) s radians;
//                 so are oct_precise, and hemi_oct, whose turn by 45 degrees halves what two steps add up to. What
//                 looks away from the eye (interpolated normals do, at silhouettes) hemi_oct turns back to there.
//   luminance     s, for grey speculars
//   rebuilt z     z^2 (f - n) / (f n) for each unit of depth. In fixed point one step, and two more of 2^-24, since the
//                 rasteriser interpolates depth in 32-bit float, whose step just below 1 that is. In float, reversed,
//                 2^-23 of z. The position lies that far along its ray; the one it is compared with may lie beside the
//                 ray, where a device interpolates over vertices snapped to 1/256 px.
// and on top of each the 32-bit arithmetic of encoding and decoding, some 1e-6.
#include "tests/gl/fixture.h"

#include "renderer/gbuffer/layout.h"

#include <glm/glm.hpp>

#include <map>
#include <optional>

namespace lightsweep {
namespace {

constexpr double kArithmetic = 4e-6;

struct Bound {
    double absolute = 0.0, relative = 0.0;
    double share = 0.0;  // of the values, may lie outside
};

Bound channel_step(const LayoutTarget& target, const StoredField& stored, size_t i) {
    const auto& format = gl::info(target.format);
    const Slot& slot = stored.slots[i];
    const bool is_signed = stored.encoding.channels[i] == Channel::signed_unit;
    const int bits = slot.bit_count > 0 ? slot.bit_count : format.bits[slot.component];
    switch (format.kind) {
        case gl::FormatKind::floating: {
            const double mantissa = bits == 32 ? 0x1p-23 : bits == 16 ? 0x1p-10 : bits == 11 ? 0x1p-6 : 0x1p-5;
            return {is_signed ? mantissa : 1e-7, mantissa};
        }
        case gl::FormatKind::snorm:
            return {1.0 / (std::ldexp(1.0, bits - 1) - 1.0), 0.0};
        case gl::FormatKind::uint:
            return {is_signed ? 1.0 / (std::ldexp(1.0, bits - 1) - 1.0) : 1.0 / (std::ldexp(1.0, bits) - 1.0), 0.0};
        default:
            return {(is_signed ? 2.0 : 1.0) / (std::ldexp(1.0, bits) - 1.0) *
                        (target.format == gl::Format::SRGB8_A8 && slot.component < 3 ? 2.4 / 1.055 : 1.0),
                    0.0};
    }
}

// The bound of a field: of the angle in radians for the normal, of the value for the rest.
Bound field_bound(const LayoutTarget& target, const StoredField& stored) {
    Bound step;
    double sum = 0.0;
    for (size_t i = 0; i < stored.slots.size(); ++i) {
        const Bound s = channel_step(target, stored, i);
        step.absolute = std::max(step.absolute, s.absolute);
        step.relative = std::max(step.relative, s.relative);
        sum += s.absolute;
    }
    const double s = step.absolute;
    const std::string& key = stored.encoding.key;
    if (key == "xyz" || key == "best_fit") return {std::sqrt(3.0) * s * 1.1 + kArithmetic};
    if (key == "oct" || key == "oct_precise" || key == "hemi_oct") return {std::sqrt(18.0) * s + kArithmetic};
    if (key == "gamma2" || key == "sqrt") return {2.0 * s + s * s + kArithmetic};
    if (key == "ycocg") return {2.0 * (2.0 * sum + sum * sum) + kArithmetic, 0.0, 0.05};
    return {step.absolute + kArithmetic, step.relative};
}

std::optional<Bound> find_bound(const Layout& layout, Field field) {
    for (const auto& target : layout.targets) {
        for (const auto& stored : target.fields) {
            if (stored.field == field) return field_bound(target, stored);
        }
    }
    return std::nullopt;
}

bool keeps_only_a_hemisphere(const Layout& layout) {
    for (const auto& target : layout.targets) {
        for (const auto& stored : target.fields) {
            if (stored.encoding.hemisphere) return true;
        }
    }
    return false;
}

class EveryLayout : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, EveryLayout, testing::ValuesIn(layout_keys()), [](const auto& c) { return c.param; });

void expect_within(const Image& truth, const Image& test, Bound bound, const std::string& what) {
    double worst = 0.0;
    size_t outside = 0;
    for (size_t i = 0; i < truth.rgb.size(); ++i) {
        const double r = static_cast<double>(truth.rgb[i]), t = static_cast<double>(test.rgb[i]);
        const double excess = std::abs(t - r) / (bound.absolute + bound.relative * std::abs(r));
        worst = std::max(worst, excess);
        outside += excess <= 1.0 ? 0 : 1;
    }
    EXPECT_LE(static_cast<double>(outside), bound.share * static_cast<double>(truth.rgb.size()))
        << what << " is off by up to " << worst << " times its bound";
}

TEST_P(EveryLayout, FieldsComeBack) {
    for (const char* scene : {"materials", "spheres"}) {
        Studio studio(scene);
        const SceneNeeds needs = scene_needs(studio.scene());
        const Layout layout = drop_unneeded(load_layout(GetParam()), needs);
        const std::map<std::string, Field> views = {
            {"base_color", Field::base_color}, {"roughness", Field::roughness}, {"metallic", Field::metallic}};
        for (const auto& [view, field] : views) {
            const auto bound = find_bound(layout, field);
            if (!bound) continue;  // the scene does not need it
            expect_within(studio.view(view, "float32"), studio.view(view, GetParam()), *bound,
                          std::string(scene) + " " + view);
        }
    }
}

TEST_P(EveryLayout, NormalsComeBack) {
    // The camera of the latter looks up a little: in view space its whole floor looks away.
    for (const char* scene : {"spheres", "atrium"}) {
        Studio studio(scene);
        const Layout layout = drop_unneeded(load_layout(GetParam()), scene_needs(studio.scene()));
        const auto bound = find_bound(layout, Field::normal);
        ASSERT_TRUE(bound);
        const bool hemisphere = keeps_only_a_hemisphere(layout);
        const Image truth = studio.view("normal", "float32"), test = studio.view("normal", GetParam());
        const Image position = studio.view("position", "float32");
        double worst = 0.0, sum = 0.0;
        size_t count = 0;
        for (size_t i = 0; i < truth.rgb.size(); i += 3) {
            const glm::dvec3 a(truth.rgb[i], truth.rgb[i + 1], truth.rgb[i + 2]);
            const glm::dvec3 b(test.rgb[i], test.rgb[i + 1], test.rgb[i + 2]);
            if (a == glm::dvec3(0.0)) continue;  // background
            EXPECT_NEAR(glm::length(b), 1.0, 1e-5) << "renormalised";
            const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
            const glm::dvec3 ray(position.rgb[i], position.rgb[i + 1], position.rgb[i + 2]);
            const double behind = hemisphere ? std::max(std::asin(glm::dot(a, glm::normalize(ray))), 0.0) : 0.0;
            worst = std::max(worst, angle - behind);
            sum += angle;
            ++count;
        }
        ASSERT_GT(count, truth.rgb.size() / 20);
        EXPECT_LE(worst, bound->absolute) << "radians, in " << scene;
        // A layout that packs must be seen to pack: the test would not notice float32 otherwise.
        if (bound->absolute > 1e-4) {
            EXPECT_GT(sum / static_cast<double>(count), bound->absolute / 100.0) << scene;
        }
    }
}

TEST_P(EveryLayout, PositionsComeBack) {
    Studio studio("atrium");
    const Camera& camera = studio.scene().camera;
    const Layout layout = drop_unneeded(load_layout(GetParam()), scene_needs(studio.scene()));
    const Image truth = studio.view("position", "float32"), test = studio.view("position", GetParam());
    const Image depth = studio.view("depth", "float32");
    const auto stored = find_bound(layout, Field::position);
    const auto& format = gl::info(layout.depth);
    const double n = camera.near_distance, f = camera.far_distance;
    const double pixel = 2.0 * std::tan(glm::radians(camera.fov_y_deg) / 2.0) / studio.height;
    double worst = 0.0;
    for (size_t i = 0; i < truth.rgb.size(); i += 3) {
        const double z = static_cast<double>(depth.rgb[i]);
        if (z == 0.0) continue;
        const glm::dvec3 a(truth.rgb[i], truth.rgb[i + 1], truth.rgb[i + 2]);
        const glm::dvec3 b(test.rgb[i], test.rgb[i + 1], test.rgb[i + 2]);
        const double far_step = format.bits[0] == 32
                                    ? 0x1p-23 * z
                                    : z * z * (f - n) / (f * n) * (std::ldexp(1.0, -format.bits[0]) + 0x1p-23);
        // A ray is |a| / z longer than the axis.
        const double allowed = stored ? stored->relative * 2.0 * glm::length(a) + 1e-6
                                      : (far_step + kArithmetic * z) * glm::length(a) / z + 1.5 * z * pixel / 256.0;
        worst = std::max(worst, glm::length(a - b) / allowed);
    }
    EXPECT_LE(worst, 1.0) << "times the bound";
}

TEST_P(EveryLayout, PictureIsNearTheControls) {
    // A bound on the picture: a field off by e changes reflected light by at most about e times how steeply the shading
    // answers, which is unbounded in a mirror's highlight; so the 90th percentile of the pixels is held, not the
    // maximum.
    Studio studio("materials");
    const auto lights = studio.lights(16);
    const Image control = studio.hdr("deferred", "float32", lights), image = studio.hdr("deferred", GetParam(), lights);
    const Layout layout = drop_unneeded(load_layout(GetParam()), scene_needs(studio.scene()));
    double step = 0.0;
    for (const Field field : {Field::normal, Field::base_color, Field::roughness})
        step += find_bound(layout, field)->absolute;
    std::vector<double> errors;
    for (size_t i = 0; i < control.rgb.size(); ++i) {
        ASSERT_TRUE(std::isfinite(image.rgb[i]));
        errors.push_back(std::abs(static_cast<double>(image.rgb[i] - control.rgb[i])) /
                         (static_cast<double>(control.rgb[i]) + 0.05));
    }
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 9 / 10),
                     errors.end());
    EXPECT_LE(errors[errors.size() * 9 / 10], 10.0 * step + 0.01);
}

}  // namespace
}  // namespace lightsweep
