// Pictures of every awkward size: one pixel, one row, one column, a pixel more or less than tiles, and as wide and as
// high as the device allows. The last tile, however little of it there is, is lit like the others.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"
#include "renderer/base/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr double kTangent = 0.6;  // of half the wider angle of view
constexpr double kDistance = 2.0;
constexpr int kLights = 48;

struct Size {
    int width, height;
};

std::vector<Size> sizes(const gl::Limits& limits) {
    const int widest = static_cast<int>(std::min(limits.max_texture_size_px, limits.max_framebuffer_width_px));
    const int highest = static_cast<int>(std::min(limits.max_texture_size_px, limits.max_framebuffer_height_px));
    return {{1, 1}, {1, 37}, {37, 1}, {17, 15}, {47, 33}, {widest, 1}, {1, highest}};
}

// A plane that fills the view, seen at an angle, under many lights that each reach a part of it.
Scene lit_plane(const Size& size) {
    Scene scene = facing_plane({.name = "matt", .model = ShadingModel::lambert, .base_color = {0.8F, 0.6F, 0.4F}}, 8.0,
                               kDistance);
    scene.camera.eye = {0.2, -0.3, kDistance};
    scene.camera.target = {0.1, 0.1, 0.0};
    const double tangent = kTangent * size.height / std::max(size.width, size.height);
    scene.camera.fov_y_deg = glm::degrees(2.0 * std::atan(tangent));
    Random random(18);
    const double edge = 1.2 * kTangent * kDistance;
    for (int i = 0; i < kLights; ++i) {
        const double x = random.uniform(-edge, edge), y = random.uniform(-edge, edge), z = random.uniform(0.15, 0.4);
        const double radius = random.uniform(0.4, 1.0);
        const glm::dvec3 color(random.uniform(0.2, 1.0), random.uniform(0.2, 1.0), random.uniform(0.2, 1.0));
        scene.lights.fixed.push_back(point_light({x, y, z}, radius, radius * radius * color));
    }
    return scene;
}

// Every pixel sees the plane, and both of its triangles are the same plane: no rasteriser needs to be asked.
std::vector<glm::dvec3> exact_picture(const Drawing& drawing) {
    Visibility visible{.width = drawing.width(), .height = drawing.height(), .triangles = {}, .texels = {}};
    visible.triangles.assign(static_cast<size_t>(drawing.width()) * drawing.height(), {0, 0});
    return drawing.reference(reference_surfaces(drawing.scene(), drawing.camera(), visible));
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    return [&bench, arm](double) {
        StressMeasurement found;
        for (const Size& size : sizes(bench.limits)) {
            Drawing drawing(bench, arm, lit_plane(size), size.width, size.height);
            const auto exact = exact_picture(drawing);
            double brightest = 0.0;
            for (const glm::dvec3& pixel : exact) brightest = std::max({brightest, pixel.x, pixel.y, pixel.z});
            const auto errors = picture_errors(exact, drawing.draw(), 0.01 * brightest);
            found.non_finite += errors.non_finite;
            if (errors.max <= found.error) continue;
            found.error = errors.max;
            found.where = fmt::format("{}x{}, {}", size.width, size.height, errors.where());
        }
        return found;
    };
}

std::vector<ArmBlock> arms() { return {with_list_builders(every_path())}; }

}  // namespace

extern const StressCase stress_odd_sizes{
    .id = "S18",
    .summary = "pictures of 1x1, 1xN, Nx1, odd sizes, remainders of a tile, and as wide and high as the device allows",
    .measures = "worst pixel against double precision, of what is brighter than 1 % of the brightest",
    .unit = "rel",
    .bound = 1800 * 0x1p-24,
    .bound_source =
        "a hundred roundings of 2^-24, 18 times over: at 1 % of a light's brightness the window (1 - q)^2, q = (d / "
        "r)^4, "
        "has q = 0.9, and takes 2 q / (1 - q) times q's error",
    .failure = "black or flickering tiles along the right and the upper edge",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
