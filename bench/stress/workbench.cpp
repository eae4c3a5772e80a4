#include "bench/stress/workbench.h"

#include "bench/plan/cell.h"
#include "renderer/base/check.h"
#include "renderer/base/names.h"
#include "renderer/paths/paths.h"
#include "renderer/post/post.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

void set_depth(const std::string& text, Layout& layout) {
    const auto words = split(text, '-');
    const auto& names = gl::format_names();
    const auto format = std::ranges::find(names, words.at(0));
    const auto& conventions = depth_convention_names();
    const auto convention = std::ranges::find(conventions, words.at(1));
    CHECK_THAT(format != names.end() && convention != conventions.end(), "depth = {}", text);
    layout.depth = static_cast<gl::Format>(format - names.begin());
    layout.convention = static_cast<DepthConvention>(convention - conventions.begin());
}

Path stress_path(const StressArm& arm, const PathSetup& setup) {
    Path path = find_path(arm.get(kPathAxis)).build(setup);
    post_tone_map.append(path);
    return path;
}

// By pixels with the top row first, three channels each.
template <class Exact>
PictureErrors errors_of(int width, int height, const Exact& exact, const Image& test, double darkest) {
    PictureErrors result;
    std::vector<double> errors;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 right = exact(x, y);
            const float* values = test.pixel(x, y);
            double difference = 0.0, magnitude = darkest;
            bool finite = true;
            for (int c = 0; c < 3; ++c) {
                if (!std::isfinite(values[c])) {
                    ++result.non_finite;
                    finite = false;
                }
                difference = std::max(difference, std::abs(double{values[c]} - right[c]));
                magnitude = std::max(magnitude, std::abs(right[c]));
            }
            if (!finite) continue;
            const double error = difference / magnitude;
            if (errors.empty() || error > result.max) {
                result.max = error;
                result.worst_x = x;
                result.worst_y = y;
            }
            errors.push_back(error);
            result.mean += error;
        }
    }
    if (errors.empty()) return result;
    result.mean /= static_cast<double>(errors.size());
    std::ranges::sort(errors);
    const auto quantile = [&](double share) {
        return errors[static_cast<size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    result.median = quantile(0.5);
    result.p999 = quantile(0.999);
    return result;
}

}  // namespace

PathSetup stress_setup(const StressArm& arm, const SceneNeeds& needs, SkipSet skips) {
    PathSetup setup{.needs = needs,
                    .layout = drop_unneeded(load_layout(arm.get(kLayoutAxis, "float32")), needs),
                    .hdr = hdr_format(arm.get(kHdrAxis, "rgba32f")),
                    .light_lists = list_builder(arm.get(kListsAxis, "cpu")),
                    .skips = skips,
                    .guards = arm.get(kGuardsAxis, "on") == "on",
                    .compensated_sums = arm.get(kSumsAxis) == kCompensatedSums};
    if (const std::string depth = arm.get(kDepthAxis); !depth.empty()) set_depth(depth, setup.layout);
    return setup;
}

Drawing::Drawing(Workbench& bench, const StressArm& arm, Scene scene, int width, int height, SkipSet skips)
    : bench_(&bench),
      scene_(std::make_unique<Scene>(std::move(scene))),
      gpu_scene_(std::make_unique<GpuScene>(*scene_, scene_needs(*scene_))),
      subject_{*gpu_scene_, scene_->lights.fixed, width, height, scene_->camera},
      arm_(stress_path(arm, stress_setup(arm, gpu_scene_->needs(), skips)),
           stress_setup(arm, gpu_scene_->needs(), skips), subject_, bench.buffers, bench.shapes) {}

Image Drawing::draw() {
    arm_.draw();
    return arm_.hdr_image();
}

std::vector<ReferenceSurface> Drawing::surfaces() const {
    return reference_surfaces(*scene_, camera(), draw_visibility(subject_, bench_->buffers, bench_->shapes));
}

std::vector<glm::dvec3> Drawing::reference(const std::vector<ReferenceSurface>& surfaces) const {
    return shade_reference(*scene_, surfaces, width(), height(), camera(), subject_.lights);
}

std::vector<DecodedSurface> Drawing::decoded() const {
    return draw_decoded_surface(arm_.setup(), subject_, bench_->buffers, bench_->shapes);
}

int64_t count_non_finite(const Image& image) {
    return std::ranges::count_if(image.rgb, [](float v) { return !std::isfinite(v); });
}

std::string PictureErrors::where() const { return fmt::format("pixel ({}, {})", worst_x, worst_y); }

PictureErrors picture_errors(const std::vector<glm::dvec3>& exact, const Image& image, double darkest) {
    CHECK_THAT(exact.size() == image.pixel_count(), "{} pixels for {}", exact.size(), image.pixel_count());
    const auto pixel = [&](int x, int y) { return exact[static_cast<size_t>(y) * image.width + x]; };
    return errors_of(image.width, image.height, pixel, image, darkest);
}

PictureErrors picture_errors(const Image& expected, const Image& test, double darkest) {
    CHECK(expected.rgb.size() == test.rgb.size());
    const auto pixel = [&](int x, int y) {
        const float* rgb = expected.pixel(x, y);
        return glm::dvec3(rgb[0], rgb[1], rgb[2]);
    };
    return errors_of(test.width, test.height, pixel, test, darkest);
}

}  // namespace lightsweep
