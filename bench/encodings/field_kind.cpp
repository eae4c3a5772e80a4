#include "bench/encodings/field_kind.h"

#include "bench/stats/quantile.h"
#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/frame/frame.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace lightsweep {
namespace {

constexpr uint64_t kSeed = 2014;

double log_uniform(Random& random, double low, double high) {
    return low * std::exp(random.uniform() * std::log(high / low));
}

// Archimedes: the height of a point on the sphere is uniform.
glm::dvec3 unit_vector(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

glm::dvec3 unit_cube(Random& random) {
    // One by one: the order of a constructor's arguments is the compiler's.
    const double r = random.uniform(), g = random.uniform(), b = random.uniform();
    return {r, g, b};
}

glm::vec4 sample_normal(Random& random) { return glm::vec4(unit_vector(random), 0.0); }
glm::vec4 sample_position(Random& random) {
    const glm::dvec3 direction = unit_vector(random);
    return glm::vec4(direction * log_uniform(random, kNearDistance, kFarDistance), 0.0);
}
glm::vec4 sample_distance(Random& random) {
    return glm::vec4(static_cast<float>(log_uniform(random, kNearDistance, kFarDistance)), 0.0F, 0.0F, 0.0F);
}
glm::vec4 sample_color(Random& random) { return glm::vec4(unit_cube(random), 0.0); }
glm::vec4 sample_radiance(Random& random) {
    const glm::dvec3 color = unit_cube(random);
    const double largest = std::max({color.r, color.g, color.b, 1e-3});
    return glm::vec4(color * (log_uniform(random, 1.0 / 16.0, 16.0) / largest), 0.0);
}
glm::vec4 sample_scalar(Random& random) { return glm::vec4(static_cast<float>(random.uniform()), 0.0F, 0.0F, 0.0F); }
glm::vec4 sample_model(Random& random) { return glm::vec4(static_cast<float>(random.index(3)), 0.0F, 0.0F, 0.0F); }

FieldErrors angle_deg(const glm::dvec4& sent, const glm::dvec4& back) {
    const glm::dvec3 a(sent), b(back);
    return {glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)))};
}
FieldErrors of_length(const glm::dvec4& sent, const glm::dvec4& back) {
    return {glm::length(glm::dvec3(back - sent)) / glm::length(glm::dvec3(sent))};
}
FieldErrors of_each_channel(const glm::dvec4& sent, const glm::dvec4& back) {
    return {std::abs(back.x - sent.x), std::abs(back.y - sent.y), std::abs(back.z - sent.z)};
}
FieldErrors of_largest_channel(const glm::dvec4& sent, const glm::dvec4& back) {
    const double largest = std::max({sent.x, sent.y, sent.z});
    return {std::abs(back.x - sent.x) / largest, std::abs(back.y - sent.y) / largest,
            std::abs(back.z - sent.z) / largest};
}
FieldErrors of_value(const glm::dvec4& sent, const glm::dvec4& back) { return {std::abs(back.x - sent.x)}; }

const FieldKind kKinds[] = {
    {"normal", "deg", "sphere", 1, sample_normal, angle_deg},
    {"depth", "rel", "0.1 to 1000, log-uniform", 1, sample_distance, of_length},
    {"position", "rel", "0.1 to 1000, log-uniform", 1, sample_position, of_length},
    {"base_color", "abs", "unit cube", 3, sample_color, of_each_channel},
    {"specular", "abs", "unit cube", 3, sample_color, of_each_channel},
    {"emissive", "rel", "1/16 to 16, log-uniform", 3, sample_radiance, of_largest_channel},
    {"roughness", "abs", "0 to 1", 1, sample_scalar, of_value},
    {"metallic", "abs", "0 to 1", 1, sample_scalar, of_value},
    {"model", "abs", "0, 1, 2", 1, sample_model, of_value},
};

bool in_patches(const Variant& variant) { return !variant.is_depth() && variant.stored().encoding.needs.neighbours; }

std::vector<glm::vec4> make_patches(const FieldKind& kind, Random& random, int width, int height) {
    std::vector<glm::vec4> pixels(static_cast<size_t>(width) * static_cast<size_t>(height));
    for (int bottom = 0; bottom < height; bottom += kPatch) {
        for (int left = 0; left < width; left += kPatch) {
            glm::vec4 corners[4];
            for (auto& corner : corners) corner = kind.sample(random);
            for (int y = 0; y < kPatch; ++y) {
                for (int x = 0; x < kPatch; ++x) {
                    const glm::vec2 at = (glm::vec2(x, y) + 0.5F) / static_cast<float>(kPatch);
                    pixels[static_cast<size_t>(bottom + y) * static_cast<size_t>(width) +
                           static_cast<size_t>(left + x)] =
                        glm::mix(glm::mix(corners[0], corners[1], at.x), glm::mix(corners[2], corners[3], at.x), at.y);
                }
            }
        }
    }
    return pixels;
}

// Turns round what looks away from the eye as its own pixel sees it.
void turn_to_eye(const shared::FrameData& frame, int width, std::vector<glm::vec4>& values) {
    for (size_t i = 0; i < values.size(); ++i) {
        const glm::vec2 pixel(i % static_cast<size_t>(width), i / static_cast<size_t>(width));
        const glm::vec2 ndc = (pixel + 0.5F) * glm::vec2(frame.pixel_to_ndc_x, frame.pixel_to_ndc_y) - 1.0F;
        const glm::vec3 ray = ndc.x * frame.ray_right + ndc.y * frame.ray_up + frame.ray_forward;
        if (glm::dot(glm::vec3(values[i]), ray) > 0.0F) values[i] = -values[i];
    }
}

}  // namespace

const FieldKind& field_kind(const std::string& field) {
    std::vector<std::string> names;
    for (const auto& kind : kKinds) {
        if (kind.field == field) return kind;
        names.emplace_back(kind.field);
    }
    throw InputError(unknown_name("field", field, names));
}

Camera probe_camera(const Variant& variant) {
    Camera camera;
    camera.eye = glm::dvec3(0.0);
    camera.target = variant.is_depth() ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(2.0, -1.0, 3.0);
    camera.near_distance = variant.near_distance;
    camera.far_distance = variant.far_distance;
    return camera;
}

shared::FrameData probe_constants(const Variant& variant, int width, int height) {
    shared::FrameData data{};
    set_camera_constants({probe_camera(variant), width, height, variant.layout.convention}, data);
    return data;
}

std::string sample_domain(const Variant& variant) {
    if (variant.hemisphere()) return "hemisphere";
    const std::string domain(field_kind(variant.field).domain);
    return in_patches(variant) ? fmt::format("{}, blends in patches of {} px", domain, kPatch) : domain;
}

std::vector<glm::vec4> make_samples(const Variant& variant, int width, int height) {
    CHECK_THAT(width % kPatch == 0 && height % kPatch == 0, "{}x{}", width, height);
    const FieldKind& kind = field_kind(variant.field);
    Random random(kSeed);
    if (in_patches(variant)) return make_patches(kind, random, width, height);
    std::vector<glm::vec4> values(static_cast<size_t>(width) * static_cast<size_t>(height));
    std::generate(values.begin(), values.end(), [&] { return kind.sample(random); });
    if (variant.hemisphere()) turn_to_eye(probe_constants(variant, width, height), width, values);
    return values;
}

ErrorSummary summarize_errors(const FieldKind& kind, std::span<const glm::vec4> sent, std::span<const glm::vec4> back) {
    CHECK_THAT(sent.size() == back.size() && !sent.empty(), "{} and {}", sent.size(), back.size());
    const auto per_value = static_cast<size_t>(kind.errors);
    std::vector<double> errors(sent.size() * per_value);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, sent.size(), 4096), [&](const auto& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
            const FieldErrors error = kind.error(glm::dvec4(sent[i]), glm::dvec4(back[i]));
            std::copy_n(error.begin(), per_value, errors.begin() + static_cast<std::ptrdiff_t>(i * per_value));
        }
    });
    size_t compared = 0;
    for (auto first = errors.begin(); first != errors.end(); first += static_cast<std::ptrdiff_t>(per_value)) {
        compared += std::all_of(first, first + kind.errors, [](double e) { return std::isfinite(e); }) ? 1 : 0;
    }
    if (compared < sent.size()) {
        constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
        return {compared, kNothing, kNothing, kNothing};
    }
    return {.compared = compared,
            .mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()),
            .p99 = quantile(errors, 0.99),
            .max = *std::max_element(errors.begin(), errors.end())};
}

}  // namespace lightsweep
