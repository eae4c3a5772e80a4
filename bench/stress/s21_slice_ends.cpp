// The slice of a cluster grid for view distances at, before and past its ends, and on every border between two: always
// one that there is, and the right one, but for rounding that the lights' bounds allow for. No picture has a surface
// before near or past far; those at both planes are drawn by S20.
#include "bench/stress/case.h"
#include "bench/stress/shader_call.h"
#include "renderer/frame/light_lists.h"
#include "shaders/shared/light_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

namespace lightsweep {
namespace {

constexpr double kNear = 0.01;
constexpr int kSamples = 1000;

// What a light's bounds are grown by, of its distance (renderer/frame/light_bounds.cpp).
constexpr double kAllowed = 0x1p-12;

struct Sliced {
    float z;
    double slice;  // as the shader says
    double begin;  // where the shader says that this slice begins
};

// What slice_of and slice_begin say of each distance.
using Slicer = std::function<std::vector<Sliced>(const shared::LightGridData&, const std::vector<float>&)>;

std::vector<Sliced> slice_on_cpu(const shared::LightGridData& grid, const std::vector<float>& distances) {
    std::vector<Sliced> result;
    for (const float z : distances) {
        const uint32_t slice = shared::slice_of(grid, z);
        result.push_back({z, double(slice), shared::slice_begin(grid, slice)});
    }
    return result;
}

Slicer slicer_in_shader() {
    const auto call = std::make_shared<ShaderCall>(std::vector<std::string>{"shared/types.h", "shared/light_cell.h"},
                                                   R"(
    LightGridData grid;
    grid.slices = uint(a.x);
    grid.slice_scale = a.y;
    grid.slice_offset = a.z;
    uint slice = slice_of(grid, a.w);
    result = vec4(float(slice), slice_begin(grid, slice), 0.0, 0.0);)");
    return [call](const shared::LightGridData& grid, const std::vector<float>& distances) {
        std::vector<ShaderInput> inputs;
        for (const float z : distances) {
            inputs.push_back({.a = {static_cast<float>(grid.slices), grid.slice_scale, grid.slice_offset, z}});
        }
        const auto answers = (*call)(inputs);
        std::vector<Sliced> result;
        for (size_t i = 0; i < answers.size(); ++i) result.push_back({distances[i], answers[i].x, answers[i].y});
        return result;
    };
}

// In double precision; 0 for the first, as slice_begin says.
double exact_begin(const shared::LightGridData& grid, double slice) {
    return slice == 0.0 ? 0.0 : std::exp2((slice - double{grid.slice_offset}) / double{grid.slice_scale});
}

// By how much of itself the distance would have to be another to be in the slice that was said; 1: there is none such.
double misplacement(const shared::LightGridData& grid, const Sliced& sliced) {
    const double last = grid.slices - 1.0;
    if (!(sliced.slice >= 0.0 && sliced.slice <= last && sliced.slice == std::floor(sliced.slice))) return 1.0;
    const double begin = exact_begin(grid, sliced.slice), z = std::max(double{sliced.z}, 0.0);
    double error = begin == 0.0 ? std::abs(sliced.begin) : std::abs(sliced.begin / begin - 1.0);
    if (z < begin) error = std::max(error, begin / std::max(z, 1e-300) - 1.0);
    if (sliced.slice < last && z > 0.0) error = std::max(error, z / exact_begin(grid, sliced.slice + 1.0) - 1.0);
    return std::min(error, 1.0);
}

// Both ends, what is beyond them, every border with its neighbours, and steps over the whole range.
std::vector<float> view_distances(const shared::LightGridData& grid, double far) {
    std::vector<float> z{-0.0F, 0.0F, -1.0F, -1e30F, 1e-38F, 1e-20F, 1e-10F, 1e10F, 1e30F, 3e38F};
    const auto add_around = [&](double at) {
        const auto middle = static_cast<float>(at);
        const float infinite = std::numeric_limits<float>::infinity();
        z.insert(z.end(), {std::nextafter(middle, 0.0F), middle, std::nextafter(middle, infinite)});
    };
    add_around(kNear);
    add_around(far);
    for (uint32_t slice = 1; slice <= grid.slices; ++slice) add_around(exact_begin(grid, slice));
    for (int i = 0; i <= kSamples; ++i) {
        z.push_back(static_cast<float>(0.1 * kNear * std::pow(100.0 * far / kNear, i / double{kSamples})));
    }
    return z;
}

// Grids of a camera: for lights all over the view, for a small one at the far end, and for none.
std::vector<shared::LightGridData> grids(double far) {
    const auto reach = [](double z, double radius) {
        shared::LightBounds light{};
        light.center = {0.0F, 0.0F, static_cast<float>(z)};
        light.radius = light.range = static_cast<float>(radius);
        return std::vector<shared::LightBounds>{light};
    };
    const FrameSetup setup{.camera = {.near_distance = kNear, .far_distance = far}, .width = 1280, .height = 720};
    std::vector<shared::LightGridData> result;
    for (const int tile_px : {8, 32, 64}) {
        const LightGridDesc desc{.tile_px = tile_px, .slices = true};
        result.push_back(make_light_grid(desc, setup, reach(0.5 * far, 0.5 * far)));
        result.push_back(make_light_grid(desc, setup, reach(far, 0.01 * far)));
        result.push_back(make_light_grid(desc, setup, {}));
    }
    return result;
}

StressTrial begin(Workbench&, const StressArm& arm) {
    const Slicer slicer = arm.get("text") == "cpp" ? Slicer(slice_on_cpu) : slicer_in_shader();
    return [slicer](double parameter) {
        StressMeasurement found;
        const double far = kNear * parameter;
        for (const shared::LightGridData& grid : grids(far)) {
            for (const Sliced& sliced : slicer(grid, view_distances(grid, far))) {
                if (!std::isfinite(sliced.slice) || !std::isfinite(sliced.begin)) ++found.non_finite;
                const double error = misplacement(grid, sliced);
                if (error <= found.error) continue;
                found.error = error;
                found.where = fmt::format("z {:.9g}: slice {} of {}", sliced.z, sliced.slice, grid.slices);
            }
        }
        return found;
    };
}

std::vector<ArmBlock> arms() { return {{{"text", {"glsl", "cpp"}}}}; }

}  // namespace

extern const StressCase stress_slice_ends{
    .id = "S21",
    .summary = "cluster slices of view distances at, before and past near and far, and on every border",
    .measures = "how far off the slice's exact ends a distance is that got its index; 1: there is no such slice",
    .unit = "rel",
    .bound = kAllowed,
    .bound_source = "lights' bounds are grown by 2^-12 of their distance: a slice that is wrong by less loses none",
    .failure = "lights vanish in front of the eye or at the far plane, or in thin shells between",
    .parameter = StressParameter{.name = "far over near", .unit = "", .easy = 2.0, .hard = 1e9, .steps = 9},
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
