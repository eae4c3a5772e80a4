#include "bench/measure/cell_error.h"

#include "bench/stats/quantile.h"
#include "renderer/base/check.h"
#include "renderer/paths/probes.h"
#include "renderer/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightsweep {
namespace {

constexpr int kRegions = 8;  // along each side
// Student's t for 63 degrees of freedom, 0.975: 64 regions give 95 %.
constexpr double kStudent63 = 1.9983;
constexpr double kUnexplained = 1e-4;  // a relative error that 32-bit arithmetic alone does not give

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

FieldError summed_up(std::string field, std::string unit, const std::vector<double>& errors) {
    return {.field = std::move(field),
            .unit = std::move(unit),
            .mean = mean_of(errors),
            .p99 = quantile(errors, 0.99),
            .max = *std::max_element(errors.begin(), errors.end())};
}

}  // namespace

Picture picture_of(Image hdr) {
    Image display = tone_mapped(hdr);
    return {std::move(hdr), std::move(display)};
}

PictureError picture_error(const Image& true_hdr, const Image& true_display, const Picture& test) {
    return {.hdr = measure_error(image_pair(true_hdr, test.hdr)),
            .display = measure_error(image_pair(true_display, test.display))};
}

PictureError control_error(const Picture& control, const Picture& test) {
    return {.hdr = measure_error(image_pair(control.hdr, test.hdr), "flip"),
            .display = measure_error(image_pair(control.display, test.display))};
}

std::optional<double> packing_share(const Image& reference, const Image& control, const Image& test) {
    CHECK(reference.rgb.size() == test.rgb.size() && control.rgb.size() == test.rgb.size());
    double along = 0.0, all = 0.0;
    for (size_t i = 0; i < test.rgb.size(); ++i) {
        const double v = test.rgb[i];
        const double error = v - static_cast<double>(reference.rgb[i]);
        along += error * (v - static_cast<double>(control.rgb[i]));
        all += error * error;
    }
    if (!(all > 0.0) || !std::isfinite(along)) return {};
    return along / all;
}

std::optional<MeanInterval> mean_interval(const FlipMap& map) {
    if (map.width < kRegions || map.height < kRegions) return {};
    std::vector<double> means;
    for (int ry = 0; ry < kRegions; ++ry) {
        for (int rx = 0; rx < kRegions; ++rx) {
            double sum = 0.0;
            size_t count = 0;
            for (int y = map.height * ry / kRegions; y < map.height * (ry + 1) / kRegions; ++y) {
                for (int x = map.width * rx / kRegions; x < map.width * (rx + 1) / kRegions; ++x) {
                    const float v = map.error[static_cast<size_t>(y) * map.width + x];
                    if (!std::isfinite(v)) continue;
                    sum += static_cast<double>(v);
                    ++count;
                }
            }
            if (count > 0) means.push_back(sum / static_cast<double>(count));
        }
    }
    if (means.size() != size_t{kRegions} * kRegions) return {};
    const double mean = mean_of(means);
    double squares = 0.0;
    for (const double m : means) squares += (m - mean) * (m - mean);
    const auto n = static_cast<double>(means.size());
    const double half_width = kStudent63 * std::sqrt(squares / (n - 1.0) / n);
    return MeanInterval{std::max(0.0, mean - half_width), mean + half_width};
}

RelativeError relative_error(const Image& reference, const Image& test, std::span<const ReferenceSurface> surfaces) {
    CHECK(reference.pixel_count() == test.pixel_count() && surfaces.size() == test.pixel_count());
    std::vector<double> errors;
    for (size_t i = 0; i < surfaces.size(); ++i) {
        const glm::dvec3 r(reference.rgb[3 * i], reference.rgb[3 * i + 1], reference.rgb[3 * i + 2]);
        const glm::dvec3 v(test.rgb[3 * i], test.rgb[3 * i + 1], test.rgb[3 * i + 2]);
        if (surfaces[i].covered && largest(r) > 0.0) errors.push_back(largest(v - r) / largest(r));
    }
    RelativeError result;
    if (errors.empty()) return result;
    result.median = median(errors);
    result.p99 = quantile(errors, 0.99);
    result.max = *std::max_element(errors.begin(), errors.end());
    result.above_1e4_px = std::count_if(errors.begin(), errors.end(), [](double e) { return !(e <= kUnexplained); });
    return result;
}

std::vector<DecodedSurface> draw_decoded_surface(const PathSetup& setup, const Subject& subject, FrameBuffers& buffers,
                                                 const DrawShapes& shapes) {
    const DecodedSurfacePath probe = build_decoded_surface(setup);
    Arm arm(probe.path, setup, subject, buffers, shapes);
    arm.draw();
    const auto position = arm.path().texture(probe.position_roughness).read_floats(4);
    const auto normal = arm.path().texture(probe.normal_metallic).read_floats(4);
    const auto color = arm.path().texture(probe.base_color_covered).read_floats(4);
    const auto rgb = [](const std::vector<float>& rgba, size_t i) {
        return glm::vec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]);
    };
    std::vector<DecodedSurface> surfaces;
    surfaces.reserve(color.size() / 4);
    for (int y = subject.height - 1; y >= 0; --y) {  // GL's first row is the bottom one
        for (int x = 0; x < subject.width; ++x) {
            const size_t i = static_cast<size_t>(y) * subject.width + x;
            surfaces.push_back({.position = rgb(position, i),
                                .normal = rgb(normal, i),
                                .base_color = rgb(color, i),
                                .roughness = position[4 * i + 3],
                                .metallic = normal[4 * i + 3],
                                .covered = color[4 * i + 3] > 0.5F});
        }
    }
    return surfaces;
}

std::vector<FieldError> field_errors(std::span<const ReferenceSurface> truth, std::span<const DecodedSurface> decoded,
                                     const SceneNeeds& needs) {
    CHECK(truth.size() == decoded.size());
    std::vector<double> normal, position, base_color, roughness, metallic;
    for (size_t i = 0; i < truth.size(); ++i) {
        const ReferenceSurface& t = truth[i];
        const DecodedSurface& d = decoded[i];
        if (!t.covered || !d.covered) continue;
        normal.push_back(angle_deg(t.normal, glm::dvec3(d.normal)));
        position.push_back(glm::length(glm::dvec3(d.position) - t.position) / glm::length(t.position));
        base_color.push_back(largest(glm::dvec3(d.base_color) - t.base_color));
        roughness.push_back(std::abs(static_cast<double>(d.roughness) - t.roughness));
        metallic.push_back(std::abs(static_cast<double>(d.metallic) - t.metallic));
    }
    if (normal.empty()) return {};
    std::vector<FieldError> result = {summed_up("normal", "deg", normal), summed_up("position", "rel", position),
                                      summed_up("base_color", "abs", base_color)};
    if (needs.roughness) result.push_back(summed_up("roughness", "abs", roughness));
    if (needs.metallic) result.push_back(summed_up("metallic", "abs", metallic));
    return result;
}

}  // namespace lightsweep
