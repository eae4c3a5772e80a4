// make_lights: the sequence of lights of a scene. Light i draws its random numbers from (seed, i) alone, so that the
// first n lights are the same whatever n is.
#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/base/random.h"
#include "renderer/scene/scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

constexpr double kPi = std::numbers::pi;

uint64_t light_seed(uint64_t seed, uint64_t index) {
    const std::array<uint64_t, 2> words{seed, index};
    return hash_bytes({reinterpret_cast<const char*>(words.data()), sizeof words});
}

// A fully bright colour of a random hue; HSV with value 1.
glm::dvec3 random_color(Random& random, double saturation) {
    const double hue = 6.0 * random.uniform();
    glm::dvec3 pure;
    for (int k = 0; k < 3; ++k) {
        const double distance =
            std::abs(std::fmod(hue - 2.0 * k + 9.0, 6.0) - 3.0);  // along the wheel from this channel
        pure[k] = std::clamp(2.0 - distance, 0.0, 1.0);
    }
    return 1.0 - saturation * (1.0 - pure);
}

// Uniform over the lower half of the sphere: spots shine down.
glm::dvec3 random_downward(Random& random) {
    const double y = -random.uniform();
    const double angle = 2.0 * kPi * random.uniform();
    const double across = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {across * std::cos(angle), y, across * std::sin(angle)};
}

// The axes along which bounds have an extent: lights in flat bounds lie in a plane, and so count as one.
std::vector<int> axes_of(const Bounds& bounds) {
    const glm::dvec3 size = bounds.size();
    const double largest = std::max({size.x, size.y, size.z});
    std::vector<int> axes;
    for (int k = 0; k < 3; ++k) {
        if (size[k] > 1e-9 * largest) axes.push_back(k);
    }
    return axes;
}

// Point i of a regular grid that grows: the bits of i are dealt to the axes in turn (Morton order) and read backwards,
// each axis a van der Corput sequence. So the first 2^(d k) points are the grid of 2^k per axis. It is shifted by a
// third of the bounds, wrapping around: at every k the grid then stays a third of its spacing, or more, inside.
glm::dvec3 grid_point(const Bounds& bounds, uint64_t index) {
    glm::dvec3 position = bounds.low;
    const auto axes = axes_of(bounds);
    for (size_t d = 0; d < axes.size(); ++d) {
        double fraction = 0.0;
        double weight = 0.5;
        for (uint64_t bits = index >> d; bits != 0; bits >>= axes.size(), weight *= 0.5) {
            if ((bits & 1U) != 0) fraction += weight;
        }
        fraction = std::fmod(fraction + 1.0 / 3.0, 1.0);
        position[axes[d]] += fraction * bounds.size()[axes[d]];
    }
    return position;
}

// Every triangle of the scene in world space, to draw points from in proportion to area.
class Surface {
  public:
    explicit Surface(const Scene& scene) : scene_(scene) {
        sums_.reserve(scene.triangle_count());
        for (const Instance& instance : scene.instances) {
            first_triangle_.push_back(sums_.size());
            for (uint32_t t = 0; t < scene.meshes[instance.mesh].index_count / 3; ++t) {
                const auto corners = triangle(instance, t);
                const double area = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
                sums_.push_back(this->area() + (std::isfinite(area) ? area : 0.0));
            }
        }
        if (area() <= 0.0)
            throw InputError(scene.key, "lights near surfaces were asked for, but no surface has an area");
    }

    double area() const { return sums_.empty() ? 0.0 : sums_.back(); }

    struct Sample {
        glm::dvec3 position, normal;
    };
    Sample sample(Random& random) const {
        const double at = random.uniform() * area();
        const auto index = static_cast<size_t>(std::upper_bound(sums_.begin(), sums_.end(), at) - sums_.begin());
        const auto next = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), index);
        const Instance& instance = scene_.instances[static_cast<size_t>(next - first_triangle_.begin()) - 1];
        const auto p = triangle(instance, static_cast<uint32_t>(index - *(next - 1)));
        // A mirroring transform turns the winding around.
        const double side = glm::determinant(glm::dmat3(instance.transform)) < 0.0 ? -1.0 : 1.0;
        const double root = std::sqrt(random.uniform());
        const double share = random.uniform();
        return {p[0] * (1.0 - root) + p[1] * (root * (1.0 - share)) + p[2] * (root * share),
                side * glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]))};
    }

  private:
    std::array<glm::dvec3, 3> triangle(const Instance& instance, uint32_t index) const {
        std::array<glm::dvec3, 3> corners;
        const uint32_t first = scene_.meshes[instance.mesh].first_index + 3 * index;
        for (uint32_t k = 0; k < 3; ++k) {
            const glm::dvec3 position = scene_.vertices[scene_.indices[first + k]].position;
            corners[k] = glm::dvec3(instance.transform * glm::dvec4(position, 1.0));
        }
        return corners;
    }

    const Scene& scene_;
    std::vector<double> sums_;            // of the areas up to and with each triangle
    std::vector<size_t> first_triangle_;  // of each instance
};

// The radius at which lights at heights spread evenly over [low, high] reach a disc of area pi * `disc` on the plane
// below them, on average: at height h, r^2 - h^2, or none of it when h is above r.
double radius_above_plane(double disc, double low, double high) {
    const double all_reach = std::sqrt(disc + (low * low + low * high + high * high) / 3.0);
    if (all_reach >= high) return all_reach;
    double below = low;
    double above = high;
    for (int step = 0; step < 60; ++step) {
        const double r = 0.5 * (below + above);
        const double reached = (r * r * (r - low) - (r * r * r - low * low * low) / 3.0) / (high - low);
        (reached < disc ? below : above) = r;
    }
    return above;
}

// The radius at which `count` lights reach a point `overlap` times on average: count * |reach| = overlap * |domain|.
double overlap_radius(const LightGenerator& generator, double overlap, int count, double surface_area) {
    const double share = overlap / count;
    if (generator.placement == Placement::surface) {
        return radius_above_plane(share * surface_area / kPi, generator.height_min, generator.height_max);
    }
    double domain = 1.0;
    const auto axes = axes_of(generator.bounds);
    for (const int axis : axes) domain *= generator.bounds.size()[axis];
    switch (axes.size()) {
        case 3:
            return std::cbrt(3.0 * share * domain / (4.0 * kPi));
        case 2:
            return std::sqrt(share * domain / kPi);
        case 1:
            return 0.5 * share * domain;
        default:
            return generator.radius;
    }
}

Light generate(const LightGenerator& generator, uint64_t index, const Surface* surface) {
    Random random(light_seed(generator.seed, index));
    Light light{.radius = generator.radius, .inner_deg = generator.inner_deg, .outer_deg = generator.outer_deg};
    light.color = generator.intensity * random_color(random, generator.saturation);
    if (random.uniform() < generator.spot_share) light.kind = LightKind::spot;
    light.direction = random_downward(random);
    switch (generator.placement) {
        case Placement::grid:
            light.position = grid_point(generator.bounds, index);
            break;
        case Placement::random:
            for (int k = 0; k < 3; ++k) {
                light.position[k] = random.uniform(generator.bounds.low[k], generator.bounds.high[k]);
            }
            break;
        case Placement::surface: {
            const auto [position, normal] = surface->sample(random);
            light.position = position + normal * random.uniform(generator.height_min, generator.height_max);
            light.direction = -normal;
            break;
        }
    }
    return light;
}

}  // namespace

std::vector<Light> make_lights(const Scene& scene, int count, RadiusRegime regime) {
    if (count < 0) throw InputError(scene.key, fmt::format("{} lights were asked for; 0 or more are allowed", count));
    if (!std::isfinite(regime.overlap) || regime.overlap < 0.0) {
        throw InputError(scene.key, fmt::format("an overlap of {} was asked for; a finite number of at least 0 is "
                                                "allowed",
                                                regime.overlap));
    }
    const auto& rig = scene.lights;
    const int written = std::min(count, static_cast<int>(rig.fixed.size()));
    std::vector<Light> lights(rig.fixed.begin(), rig.fixed.begin() + written);
    if (count == written) return lights;
    if (!rig.generator) {
        throw InputError(scene.key, fmt::format("{} lights were asked for, but the scene holds {} and no generator",
                                                count, written));
    }
    const LightGenerator& generator = *rig.generator;
    CHECK(generator.placement == Placement::surface || !generator.bounds.empty());
    std::optional<Surface> surface;
    if (generator.placement == Placement::surface) surface.emplace(scene);

    const int generated = count - written;
    double shrink = 1.0;
    if (regime.overlap > 0.0) {
        const double area = surface ? surface->area() : 0.0;
        shrink = std::min(1.0, overlap_radius(generator, regime.overlap, generated, area) / generator.radius);
    }
    lights.resize(static_cast<size_t>(count));
    tbb::parallel_for(0, generated, [&](int i) {
        Light& light = lights[static_cast<size_t>(written + i)];
        light = generate(generator, static_cast<uint64_t>(i), surface ? &*surface : nullptr);
        light.radius *= shrink;
        light.color *= shrink * shrink;
    });
    return lights;
}

}  // namespace lightsweep
