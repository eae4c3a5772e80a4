#include "renderer/frame/light_bounds.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

// Of the distance: what single precision takes from positions, from log2 and exp2 in shaders and from the tests of
// shaders/shared/light_cell.h, many times over.
constexpr double kRounding = 0x1p-12;

// Of a spot's cosine, by what LightData and the shaders' dot products may be off.
constexpr double kCosineRounding = 0x1p-21;

constexpr double kNoCone = -1.0;

struct View {
    glm::dvec3 right, up, forward;
    double growth;  // of radii, per distance from the eye
    glm::dvec3 from_world(const glm::dvec3& v) const {
        return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, forward)};
    }
};

// A surface at p is read as p' with |p' - p| <= e |p|. Its pixel is that of p, its slice that of p'. So its cell holds
// the point q of p's ray at the view distance of p', and |q - p'| <= e |p| / cos(angle between the ray and forward).
// The bounds of a light that reaches p' must hold both p and q. The cosine is least in the corners of the picture, and
// |p| <= |p'| / (1 - e), where p' is no further from the eye than the light and its radius.
double growth_per_distance(const shared::FrameData& data, double position_error) {
    const glm::dvec3 corner(data.ray_right + data.ray_up + data.ray_forward);
    return position_error / (1.0 - position_error) * glm::length(corner) + kRounding;
}

shared::LightBounds bounds_of(const shared::LightData& light, const View& view) {
    const glm::dvec3 apex = view.from_world(glm::dvec3(light.position));
    const double range = light.radius;
    const double growth = view.growth * (glm::length(apex) + range);
    shared::LightBounds bounds{.center = glm::vec3(apex),
                               .radius = static_cast<float>(range + growth),
                               .apex = glm::vec3(apex),
                               .range = static_cast<float>(range + growth),
                               .axis = {0.0F, 0.0F, 1.0F},
                               .cos_half_angle = static_cast<float>(kNoCone)};
    if (light.spot_scale == 0.0F) return bounds;

    const double cosine = -double{light.spot_offset} / double{light.spot_scale} - kCosineRounding;
    const glm::dvec3 axis = glm::normalize(view.from_world(glm::dvec3(light.direction)));
    const Sphere sphere = sphere_around_cone(apex, axis, range, cosine);
    bounds.center = glm::vec3(sphere.center);
    bounds.radius = static_cast<float>(sphere.radius + growth);
    // Everything within `growth` of a cone is in the cone with the same axis and an angle no smaller whose apex is
    // growth / sin(angle) further back: there the sides are that far from the apex, and no nearer farther on. A narrow
    // cone is widened first, to where moving it back (growth / sine) and widening it (range * sine) cost the same.
    const double sine = std::max(std::sqrt(1.0 - cosine * cosine), std::sqrt(growth / range));
    if (cosine <= 0.0 || sine >= 1.0) return bounds;
    const double back = growth / sine;
    bounds.apex = glm::vec3(apex - back * axis);
    bounds.range = static_cast<float>(range + growth + back);
    bounds.axis = glm::vec3(axis);
    bounds.cos_half_angle = static_cast<float>(std::sqrt(1.0 - sine * sine));
    return bounds;
}

// The slopes across / z, lowest and highest, of the points of a disc around (across, z) with z > 0; the disc has some.
struct Slopes {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
};

Slopes disc_slopes_in_front(double across, double z, double radius) {
    const double tangent_squared = across * across + z * z - radius * radius;
    if (tangent_squared <= 0.0) return {};
    // Both tangents from the eye; one that touches behind the eye leaves its side open.
    const double tangent = std::sqrt(tangent_squared);
    const double z_lowest = z * tangent + across * radius, z_highest = z * tangent - across * radius;
    Slopes slopes;
    if (z_lowest > 0.0) slopes.low = (across * tangent - z * radius) / z_lowest;
    if (z_highest > 0.0) slopes.high = (across * tangent + z * radius) / z_highest;
    return slopes;
}

// The pixels whose centres are within the slopes, [first, second). What is no number is everywhere: comparisons with it
// are false.
std::pair<int, int> pixels_within(const Slopes& slopes, double tangent, int size) {
    const double px_per_slope = 0.5 * size / tangent;
    const double first = std::ceil((slopes.low + tangent) * px_per_slope - 0.5);
    const double last = std::floor((slopes.high + tangent) * px_per_slope - 0.5);
    return {static_cast<int>(std::min(std::max(0.0, first), double(size))),
            static_cast<int>(std::max(std::min(double(size), last + 1.0), 0.0))};
}

}  // namespace

Sphere sphere_around_cone(const glm::dvec3& apex, const glm::dvec3& axis, double range, double cos_half_angle) {
    if (cos_half_angle <= 0.0) return {apex, range};
    // Through the rim and, when the cone is narrow, the apex.
    const double along = cos_half_angle > std::sqrt(0.5) ? 0.5 / cos_half_angle : cos_half_angle;
    const double radius = std::max(along, std::sqrt(std::max(0.0, 1.0 - cos_half_angle * cos_half_angle)));
    return {apex + range * along * axis, range * radius};
}

void light_bounds(const Frame& frame, double position_error, std::vector<shared::LightBounds>& bounds) {
    CHECK_THAT(position_error >= 0.0 && position_error <= 0.125, "position_error = {}", position_error);
    const View view{glm::normalize(glm::dvec3(frame.data.ray_right)), glm::normalize(glm::dvec3(frame.data.ray_up)),
                    glm::normalize(glm::dvec3(frame.data.ray_forward)),
                    growth_per_distance(frame.data, position_error)};
    bounds.clear();
    for (size_t i = frame.data.directional_count; i < frame.lights.size(); ++i) {
        bounds.push_back(bounds_of(frame.lights[i], view));
    }
}

PixelRect screen_rect(const shared::LightBounds& light, const FrameSetup& setup) {
    const glm::dvec3 center(light.center);
    const double radius = light.radius;
    if (center.z + radius <= 0.0) return {};
    const double tan_y = std::tan(glm::radians(setup.camera.fov_y_deg) / 2.0);
    const double tan_x = tan_y * setup.width / setup.height;
    const auto [x0, x1] = pixels_within(disc_slopes_in_front(center.x, center.z, radius), tan_x, setup.width);
    const auto [y0, y1] = pixels_within(disc_slopes_in_front(center.y, center.z, radius), tan_y, setup.height);
    const PixelRect rect{x0, y0, x1, y1};
    return rect.empty() ? PixelRect{} : rect;
}

}  // namespace lightsweep
