// A frame's lights on one core, at 1280x720 in the atrium, about 16 of them at every point: culling, bounds, and the
// lists of the grids that paths ask for. Items are lights.
#include "bench/micro/guarded.h"
#include "bench/micro/stages.h"
#include "renderer/frame/light_lists.h"

#include <array>
#include <string>
#include <vector>

namespace lightsweep {
namespace {

struct Input {
    std::vector<Light> lights;
    Frame frame;
};

Input make_input(int count, double spot_share) {
    Scene scene = load_scene("atrium");
    scene.lights.generator->spot_share = spot_share;
    Input input;
    input.lights = make_lights(scene, count, {.overlap = 16.0});
    input.frame.setup = {.camera = scene.camera, .width = 1280, .height = 720};
    set_camera_constants(input.frame.setup, input.frame.data);
    collect_lights(input.lights, input.frame);
    return input;
}

void collect(benchmark::State& state, int count, double spot_share) {
    Input input = make_input(count, spot_share);
    for (auto _ : state) {
        collect_lights(input.lights, input.frame);
        benchmark::DoNotOptimize(input.frame.lights.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["kept"] = static_cast<double>(input.frame.lights.size());
}

void bounds(benchmark::State& state, int count, double spot_share) {
    const Input input = make_input(count, spot_share);
    std::vector<shared::LightBounds> result;
    for (auto _ : state) {
        light_bounds(input.frame, 0.0, result);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * count);
}

// The tiles' depths, where there are some, span a tenth of the view distance, as floors and walls do.
void lists(benchmark::State& state, int count, double spot_share, const LightGridDesc& desc) {
    const Input input = make_input(count, spot_share);
    std::vector<shared::LightBounds> all;
    light_bounds(input.frame, 0.0, all);
    shared::LightGridData grid = make_light_grid(desc, input.frame.setup, all);
    std::vector<DepthRange> depths;
    for (size_t i = 0; desc.depth_bounds && i < cell_count(grid); ++i) {
        const float z = 4.0F + 36.0F * static_cast<float>(i) / static_cast<float>(cell_count(grid));
        depths.push_back({z, 1.1F * z});
    }
    LightLists result;
    for (auto _ : state) {
        grid = make_light_grid(desc, input.frame.setup, all);
        build_light_lists(grid, all, depths, 0, result);
        benchmark::DoNotOptimize(result.indices.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["cells"] = static_cast<double>(result.cells.size());
    state.counters["indices"] = static_cast<double>(result.indices.size());
}

}  // namespace

void add_light_list_stages() {
    static constexpr std::array<std::pair<LightGridDesc, const char*>, 2> kGrids{
        {{{.tile_px = 16, .depth_bounds = true}, "tiles"}, {{.tile_px = 32, .slices = true}, "clusters"}}};
    for (const auto& [spot_share, kind] : {std::pair(0.0, "points"), std::pair(1.0, "spots")}) {
        for (const int count : {1, 1 << 10, 1 << 14, 1 << 16}) {
            const auto add = [&, kind = kind, share = spot_share](const std::string& stage, auto body) {
                add_benchmark("light_lists/" + stage + "/" + kind + ":" + std::to_string(count),
                              [=](benchmark::State& state) { body(state, count, share); })
                    ->Unit(benchmark::kMicrosecond);
            };
            add("collect", collect);
            add("bounds", bounds);
            for (const auto& [desc, word] : kGrids) {
                add(word, [desc = desc](benchmark::State& state, int lights, double share) {
                    lists(state, lights, share, desc);
                });
            }
        }
    }
}

}  // namespace lightsweep
