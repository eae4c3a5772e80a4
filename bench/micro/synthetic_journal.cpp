#include "bench/micro/synthetic_journal.h"

#include "bench/report/time_error.h"
#include "renderer/base/random.h"

#include <array>

namespace lightsweep {
namespace {

// Integer nanoseconds around `center_ns`, 5 percent to either side.
int64_t frame_time_ns(double center_ns, Random& random) {
    return static_cast<int64_t>(center_ns * random.uniform(0.95, 1.05));
}

ImageError image_error(Random& random) {
    ImageError error;
    for (size_t i = 0; i < metric_value_keys().size(); ++i) error.values.emplace_back(random.uniform(0.0, 0.1));
    return error;
}

CellError cell_error(bool has_layout, Random& random) {
    CellError error;
    error.reference = {.hdr = image_error(random), .display = image_error(random)};
    error.control = {.hdr = image_error(random), .display = image_error(random)};
    error.packing_share = random.uniform(0.0, 1.0);
    error.flip_mean_low = 0.9 * *error.reference->display.value(kErrorMetric);
    error.flip_mean_high = 1.1 * *error.reference->display.value(kErrorMetric);
    if (has_layout) {
        for (const auto& [field, unit] : {std::pair{"normal", "deg"}, {"position", "rel"}, {"base_color", "abs"}}) {
            const double mean = random.uniform(0.0, 0.01);
            error.fields.push_back({.field = field, .unit = unit, .mean = mean, .p99 = 3.0 * mean, .max = 9.0 * mean});
        }
    }
    return error;
}

CellResult cell_result(const CellParams& params, int frames, double center_ns, Random& random) {
    CellResult cell;
    cell.id = params.id();
    cell.group = params.group();
    cell.name = params.name();
    cell.params = params;
    cell.work = CellWork{.draws = 30, .triangles = 250'000, .light_evaluations = 1'000'000, .skipped = {}};
    cell.first_frame_ns = static_cast<int64_t>(10.0 * center_ns);
    cell.stop_reason = "target_ci";
    cell.samples.passes = {{"gbuffer", {}}, {"shade", {}}, {"unattributed", {}}};
    for (int frame = 0; frame < frames; ++frame) {
        const int64_t wall_ns = frame_time_ns(center_ns, random);
        const int64_t cpu_ns = wall_ns / 20, gpu_ns = wall_ns - cpu_ns;
        cell.samples.round.push_back(frame);
        cell.samples.cpu_ns.push_back(cpu_ns);
        cell.samples.gpu_ns.push_back(gpu_ns);
        cell.samples.wall_ns.push_back(wall_ns);
        const int64_t gbuffer_ns = gpu_ns / 3, shade_ns = gpu_ns / 2;
        const std::array<int64_t, 3> passes_ns{gbuffer_ns, shade_ns, gpu_ns - gbuffer_ns - shade_ns};
        for (size_t p = 0; p < passes_ns.size(); ++p) cell.samples.passes[p].second.push_back(passes_ns[p]);
    }
    cell.error = cell_error(!params.layout.empty(), random);
    return cell;
}

}  // namespace

JournalContent synthetic_journal(int groups, int frames) {
    static const std::array<std::pair<std::string, std::string>, kSyntheticArms> kArms{{
        {"forward", ""},
        {"forward_prepass", ""},
        {"deferred", "float32"},
        {"deferred", "oct16"},
        {"deferred", "packed"},
        {"deferred_volumes", "float32"},
        {"deferred_volumes", "oct16"},
        {"deferred_volumes", "packed"},
    }};
    Random random(1);
    JournalContent journal;
    journal.run.planned_cells = journal.run.plan_cells = int64_t{groups} * kSyntheticArms;
    for (int g = 0; g < groups; ++g) {
        GroupResult group;
        double center_ns = 5e6 + 1e6 * g;
        for (const auto& [path, layout] : kArms) {
            const CellParams params{
                .scene = "atrium", .lights = 16 * (g + 1), .overlap = 0.0, .path = path, .layout = layout};
            group.cells.push_back(cell_result(params, frames, center_ns, random));
            center_ns *= 1.1;
        }
        group.reference = {.key = "0011223344556677",
                           .from_cache = true,
                           .seconds = 0.01,
                           .subpixel_bits = 8,
                           .control_exact = RelativeError{.median = 1e-7, .p99 = 1e-6, .max = 1e-3, .above_1e4_px = 9},
                           .control_snapped = {}};
        const CellResult& first = group.cells.front();
        group.group = first.group;
        group.noise = NoiseTwin{first.name, first.samples.round, {}};
        for (const int64_t wall_ns : first.samples.wall_ns) {
            group.noise->wall_ns.push_back(frame_time_ns(static_cast<double>(wall_ns), random));
        }
        journal.groups.push_back(std::move(group));
    }
    return journal;
}

}  // namespace lightsweep
