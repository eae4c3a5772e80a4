#include "bench/measure/cell_error.h"

#include "bench/stats/quantile.h"
#include "renderer/base/check.h"
#include "renderer/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightsweep {
namespace {

constexpr int kRegions = 8;  // along each side
// Student's t for 63 degrees of freedom, 0.975: 64 regions give 95 %.
constexpr double kStudent63 = 1.9983;
constexpr double kUnusual = 1e-4;  // a relative error that 32-bit arithmetic alone does not give

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool finite(const DecodedSurface& s) {
    return finite(s.position) && finite(s.normal) && finite(s.base_color) && finite(s.specular) && finite(s.emissive) &&
           std::isfinite(s.roughness) && std::isfinite(s.metallic);
}

/// One field's errors, pixel by pixel.
class FieldErrors {
  public:
    FieldErrors(std::string field, std::string unit) : field_(std::move(field)), unit_(std::move(unit)) {}
    void add(double error) { errors_.push_back(error); }
    bool empty() const { return errors_.empty(); }
    FieldError summed_up() const {
        return {.field = field_,
                .unit = unit_,
                .mean = mean_of(errors_),
                .p99 = quantile(errors_, 0.99),
                .max = *std::max_element(errors_.begin(), errors_.end())};
    }

  private:
    std::string field_, unit_;
    std::vector<double> errors_;
};

}  // namespace

Picture picture_of(Image hdr) {
    Image display = tone_mapped(hdr);
    return {std::move(hdr), std::move(display)};
}

PictureError picture_error(const Picture& truth, const Picture& test, HdrFlip hdr_flip) {
    return {.hdr = measure_error(image_pair(truth.hdr, test.hdr), hdr_flip == HdrFlip::measure ? "" : "flip"),
            .display = measure_error(image_pair(truth.display, test.display))};
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
    RelativeError result;
    std::vector<double> errors;
    for (size_t i = 0; i < surfaces.size(); ++i) {
        const glm::dvec3 r(reference.rgb[3 * i], reference.rgb[3 * i + 1], reference.rgb[3 * i + 2]);
        const glm::dvec3 v(test.rgb[3 * i], test.rgb[3 * i + 1], test.rgb[3 * i + 2]);
        if (!surfaces[i].covered || largest(r) == 0.0) continue;
        if (finite(glm::vec3(r)) && finite(glm::vec3(v))) {
            errors.push_back(largest(v - r) / largest(r));
        } else {
            ++result.above_1e4_px;
        }
    }
    if (errors.empty()) return result;
    result.median = median(errors);
    result.p99 = quantile(errors, 0.99);
    result.max = *std::max_element(errors.begin(), errors.end());
    result.above_1e4_px += std::count_if(errors.begin(), errors.end(), [](double e) { return e > kUnusual; });
    return result;
}

LayoutError layout_error(std::span<const ReferenceSurface> truth, std::span<const DecodedSurface> decoded,
                         const SceneNeeds& needs) {
    CHECK(truth.size() == decoded.size());
    LayoutError result;
    FieldErrors normal("normal", "deg"), position("position", "rel"), base_color("base_color", "abs"),
        specular("specular", "abs"), roughness("roughness", "abs"), metallic("metallic", "abs"),
        emissive("emissive", "rel");
    for (size_t i = 0; i < truth.size(); ++i) {
        const ReferenceSurface& t = truth[i];
        const DecodedSurface& d = decoded[i];
        if (!t.covered && !d.covered) continue;
        if (t.covered != d.covered || !finite(d)) {
            ++result.lost_px;
            continue;
        }
        normal.add(angle_deg(t.normal, glm::dvec3(d.normal)));
        position.add(glm::length(glm::dvec3(d.position) - t.position) / glm::length(t.position));
        base_color.add(largest(glm::dvec3(d.base_color) - t.base_color));
        specular.add(largest(glm::dvec3(d.specular) - t.specular));
        roughness.add(std::abs(static_cast<double>(d.roughness) - t.roughness));
        metallic.add(std::abs(static_cast<double>(d.metallic) - t.metallic));
        if (largest(t.emissive) > 0.0) {
            emissive.add(largest(glm::dvec3(d.emissive) - t.emissive) / largest(t.emissive));
        }
    }
    const std::pair<const FieldErrors*, bool> fields[] = {{&normal, true},
                                                          {&position, true},
                                                          {&base_color, true},
                                                          {&specular, needs.specular},
                                                          {&roughness, needs.roughness},
                                                          {&metallic, needs.metallic},
                                                          {&emissive, needs.emissive}};
    for (const auto& [errors, needed] : fields) {
        if (needed && !errors->empty()) result.fields.push_back(errors->summed_up());
    }
    return result;
}

}  // namespace lightsweep
