// The reference's stages at 1280x720, on all cores. Items are pixels, except where lights shade: there they are the
// evaluations of one light at one pixel that it reaches, and, for the yardstick, single multiplications and additions.
#include "bench/micro/guarded.h"
#include "bench/micro/stages.h"
#include "renderer/reference/cast_visibility.h"
#include "renderer/reference/clones.h"
#include "renderer/reference/reference.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <map>
#include <string>
#include <vector>

namespace lightsweep {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int64_t kPixels = int64_t{kWidth} * kHeight;

// The atrium seen from its own camera, all of it in one shading model.
struct Shot {
    Scene scene;
    Visibility visible;
    std::vector<ReferenceSurface> surfaces;
};

const Shot& atrium(ShadingModel model) {
    static std::map<ShadingModel, Shot> shots;
    const auto [found, is_new] = shots.try_emplace(model);
    Shot& shot = found->second;
    if (!is_new) return shot;
    shot.scene = load_scene("atrium");
    for (Material& material : shot.scene.materials) material.model = model;
    shot.visible = cast_visibility(shot.scene, shot.scene.camera, kWidth, kHeight);
    shot.surfaces = reference_surfaces(shot.scene, shot.scene.camera, shot.visible);
    return shot;
}

int64_t count_evaluations(const Shot& shot, const std::vector<Light>& lights) {
    int64_t count = 0;
    for (const ReferenceSurface& surface : shot.surfaces) {
        if (!surface.covered) continue;
        for (const Light& light : lights) {
            const glm::dvec3 to_light = light.position - shot.scene.camera.eye - surface.position;
            count += glm::dot(to_light, to_light) < light.radius * light.radius ? 1 : 0;
        }
    }
    return count;
}

void add_shading(ShadingModel model, const std::string& name, const std::vector<Light>& lights) {
    const auto body = [model, lights](benchmark::State& state) {
        const Shot& shot = atrium(model);
        for (auto _ : state) {
            benchmark::DoNotOptimize(
                shade_reference(shot.scene, shot.surfaces, kWidth, kHeight, shot.scene.camera, lights));
        }
        state.SetItemsProcessed(state.iterations() * count_evaluations(shot, lights));
    };
    add_benchmark("reference/shade/" + kShadingModelNames[static_cast<size_t>(model)] + "/" + name, body)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

// Chains enough to fill the pipelines, in vectors as wide as any processor's.
using Wide = double __attribute__((vector_size(64)));
constexpr int kChains = 8;
constexpr int64_t kSteps = 1 << 20;

LIGHTSWEEP_CLONES void multiply_and_add(double* values) {
    Wide a = {1}, b = {2}, c = {3}, d = {4}, e = {5}, f = {6}, g = {7}, h = {8};
    const Wide factor = a * 0.0 + 0.999, addend = a * 0.0 + 0.001;
    for (int64_t i = 0; i < kSteps; ++i) {
        a = a * factor + addend;
        b = b * factor + addend;
        c = c * factor + addend;
        d = d * factor + addend;
        e = e * factor + addend;
        f = f * factor + addend;
        g = g * factor + addend;
        h = h * factor + addend;
    }
    const Wide sum = a + b + c + d + e + f + g + h;
    for (int i = 0; i < 8; ++i) values[i] = sum[i];
}

void add_arithmetic_peak() {
    const auto body = [](benchmark::State& state) {
        const int cores = tbb::this_task_arena::max_concurrency();
        for (auto _ : state) {
            tbb::parallel_for(0, cores, [](int) {
                double values[8];
                multiply_and_add(values);
                benchmark::DoNotOptimize(values);
            });
        }
        state.SetItemsProcessed(state.iterations() * cores * kSteps * kChains * 8 * 2);
    };
    add_benchmark("reference/arithmetic_peak", body)->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace

void add_reference_stages() {
    const auto surfaces = [](benchmark::State& state, int subpixel_bits) {
        const Shot& shot = atrium(ShadingModel::ggx);
        for (auto _ : state) {
            benchmark::DoNotOptimize(reference_surfaces(shot.scene, shot.scene.camera, shot.visible, subpixel_bits));
        }
        state.SetItemsProcessed(state.iterations() * kPixels);
    };
    for (const int bits : {0, 8}) {
        add_benchmark("reference/surfaces/snapped_bits:" + std::to_string(bits),
                      [=](benchmark::State& state) { surfaces(state, bits); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    std::vector<Light> all_reach = make_lights(load_scene("atrium"), 256, {});
    for (Light& light : all_reach) light.radius = 1e3;
    for (const auto model : {ShadingModel::ggx, ShadingModel::blinn_phong, ShadingModel::lambert}) {
        add_shading(model, "lights:1024/overlap:16", make_lights(load_scene("atrium"), 1024, {.overlap = 16.0}));
        add_shading(model, "lights:256/all_reach", all_reach);
    }

    const auto display = [](benchmark::State& state) {
        const Shot& shot = atrium(ShadingModel::ggx);
        const auto lights = make_lights(shot.scene, 64, {.overlap = 16.0});
        const Image image = to_image(
            shade_reference(shot.scene, shot.surfaces, kWidth, kHeight, shot.scene.camera, lights), kWidth, kHeight);
        for (auto _ : state) benchmark::DoNotOptimize(tone_mapped(image));
        state.SetItemsProcessed(state.iterations() * kPixels);
    };
    add_benchmark("reference/tone_mapped", display)->Unit(benchmark::kMillisecond)->UseRealTime();
    add_arithmetic_peak();
}

}  // namespace lightsweep
