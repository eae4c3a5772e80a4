#include "bench/micro/cells.h"

#include "bench/measure/catalog.h"
#include "bench/measure/list_probe.h"
#include "bench/measure/self_test.h"
#include "bench/micro/guarded.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightsweep {
namespace {

constexpr int kWarmUpFrames = 2;  // after the first, which compiles

Plan plan_cells(const std::string& sweep, const std::vector<std::string>& axes) {
    const Catalog names = program_catalog();
    return make_plan(load_sweep(sweep, names), parse_axis_arguments(axes, names), {}, {}, names);
}

// The library has no limit of its own on wrong times: a time is used when the wall clock, which saw all of the frame,
// agrees that it is possible.
bool possible(const FrameSample& sample) {
    return sample.gpu.total_ns > 0 &&
           static_cast<double>(sample.gpu.total_ns) <= kHighestRatio * static_cast<double>(sample.wall_ns);
}

}  // namespace

// The group whose cells are being run. Its arms live together, as in a run, so that the library's random interleaving
// finds them warm; they go when a cell of another group is asked for.
struct CellBenchmarks::LiveGroup {
    std::string key;
    Subject subject;
    FrameBuffers buffers;
    DrawShapes shapes;
    std::map<std::string, std::unique_ptr<Arm>> arms;  // by the cell's name
};

CellBenchmarks::CellBenchmarks(const std::string& sweep, const std::vector<std::string>& axes)
    : plan_(plan_cells(sweep, axes)) {}

CellBenchmarks::~CellBenchmarks() = default;

void CellBenchmarks::add(int repetitions) {
    for (const PlanGroup& group : plan_.groups) {
        for (const CellParams& cell : group.cells) {
            if (cell.path == kAutoPath) continue;  // another cell's path by another name
            auto* benchmark = add_benchmark(cell.name(), [this, &cell](benchmark::State& state) { run(state, cell); });
            benchmark->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
            if (repetitions > 0) benchmark->Repetitions(repetitions);
        }
    }
}

bool CellBenchmarks::owns(std::string_view name) const {
    return std::ranges::any_of(plan_.groups, [&](const PlanGroup& group) {
        return std::ranges::any_of(group.cells, [&](const CellParams& cell) { return name.starts_with(cell.name()); });
    });
}

std::string CellBenchmarks::choose_timer(const std::string& forced) {
    timer_method_ = forced.empty() ? lightsweep::choose_timer(test_timers(all_timers())).method : forced;
    timer_ = make_frame_timer(timer_method_);
    return timer_method_;
}

Arm& CellBenchmarks::prepared_arm(const CellParams& cell) {
    if (!live_ || live_->key != cell.group()) {
        live_.reset();
        const GpuScene& gpu_scene = scenes_.gpu_scene(cell.scene);
        const LightRig& rig = gpu_scene.scene().lights;
        auto lights = make_lights(gpu_scene.scene(), cell.lights.value_or(rig.default_count),
                                  {cell.overlap.value_or(rig.default_overlap)});
        live_ = std::make_unique<LiveGroup>(LiveGroup{
            .key = cell.group(),
            .subject = {.scene = gpu_scene, .lights = std::move(lights), .width = cell.width, .height = cell.height},
            .buffers = {},
            .shapes = {},
            .arms = {}});
    }
    auto& slot = live_->arms[cell.name()];
    if (!slot) {
        CellParams drawn = cell;
        if (drawn.light_lists == kAutoLightLists) {
            if (faster_lists_.empty()) {
                faster_lists_ = list_builder_names()[static_cast<size_t>(probe_light_lists().faster())];
            }
            drawn.light_lists = faster_lists_;
        }
        auto arm = std::make_unique<Arm>(drawn, live_->subject, live_->buffers, live_->shapes);
        for (int i = 0; i < 1 + kWarmUpFrames; ++i) arm->draw();
        gl::Context::current()->throw_on_debug_errors(cell.name());
        slot = std::move(arm);
    }
    return *slot;
}

void CellBenchmarks::run(benchmark::State& state, const CellParams& cell) {
    Arm& arm = prepared_arm(cell);
    FrameSample sample;
    for (auto _ : state) {
        sample = arm.sample(*timer_);
        if (!possible(sample)) {
            state.SkipWithError(fmt::format("the timer {} says {} ns of a frame that took {} ns by the clock",
                                            timer_method_, sample.gpu.total_ns, sample.wall_ns)
                                    .c_str());
            return;
        }
        state.SetIterationTime(static_cast<double>(sample.gpu.total_ns) * 1e-9);
    }
    state.counters["cpu_ns"] = static_cast<double>(sample.cpu_ns);
    state.counters["wall_ns"] = static_cast<double>(sample.wall_ns);
    state.counters["bytes_per_px"] = arm.path().bytes_per_pixel();
    // Of a counter that is zero in every repetition the library writes NaN as the variation, which is not JSON.
    const size_t lights = live_->subject.lights.size();
    if (lights > 0) state.counters["lights"] = static_cast<double>(lights);
}

}  // namespace lightsweep
