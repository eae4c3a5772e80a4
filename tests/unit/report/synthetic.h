// Journals whose truth is known: log-normal frame times around planted medians, with a drift that all arms share.
#pragma once

#include "bench/report/journal.h"

#include "renderer/base/random.h"

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

/// Planted median of wall_ns of a cell.
using TimeModel = std::function<double(const CellParams&)>;

inline RunInfo synthetic_run(int64_t planned_cells) {
    return {.arguments = {"run", "default"},
            .version = "0.1.0",
            .git_commit = "0123abc",
            .build_type = "Release",
            .seed = 7,
            .plan_hash = "00112233445566aa",
            .shard = {},
            .planned_cells = planned_cells,
            .plan_cells = planned_cells,
            .started_at = "2024-05-01T12:00:00Z",
            .time_budget_s = 60.0,
            .target_ci = 0.02,
            .max_frame_s = 1.5,
            .max_error = {},
            .max_time_ns = {}};
}

inline Environment synthetic_environment() {
    Environment environment{.cpu = "a \"cpu\"",
                            .cores = 2,
                            .memory_bytes = int64_t{8} << 30,
                            .os = "Linux",
                            .gl_provider = "egl_surfaceless",
                            .gl_vendor = "Mesa",
                            .gl_renderer = "llvmpipe",
                            .gl_version = "4.5",
                            .software = true,
                            .driver_variables = {{"LP_NUM_THREADS", "2"}},
                            .workarounds = {},
                            .compiler = "gcc 12",
                            .fingerprint = {}};
    environment.fingerprint = environment_fingerprint(environment);
    return environment;
}

inline TimerReport synthetic_timer() {
    const TimerCase good{.kind = "fragment",
                         .target_px = {64, 64},
                         .framebuffers = 2,
                         .work = {1, 2, 4},
                         .measured_ns = {100, 200, 400},
                         .yardstick_ns = {101, 201, 401},
                         .ratio = 0.99,
                         .linearity = 0.999};
    TimerCase broken = good;
    broken.ratio = std::nullopt;
    broken.linearity = std::nan("");
    return {.method = "finish_clock",
            .forced = false,
            .why = "cheapest accepted",
            .methods = {{"finish_clock", true, "within bounds", 120, {good}},
                        {"timestamp", false, "ratio 0.001", std::nullopt, {broken}}}};
}

inline CellParams arm(const std::string& path, const std::string& layout, int lights) {
    return {.scene = "cornell",
            .lights = lights,
            .width = 640,
            .height = 360,
            .overlap = 0.0,
            .path = path,
            .layout = layout,
            .light_lists = path.ends_with("tiled") || path.ends_with("clustered") ? "auto" : "",
            .hdr = "rgba16f"};
}

/// Every number not in `values` is not defined.
inline ImageError synthetic_image_error(const std::map<std::string_view, double>& values) {
    ImageError error;
    for (const std::string_view key : metric_value_keys()) {
        const auto found = values.find(key);
        error.values.push_back(found == values.end() ? std::nullopt : std::optional(found->second));
    }
    return error;
}

/// With the FLIP mean's interval 10 % to either side.
inline CellError synthetic_error(double flip_mean, double flip_mean_of_packing) {
    const auto picture = [](double flip) {
        return PictureError{.hdr = synthetic_image_error({{"rmse", 5.0 * flip}, {"nonfinite_px", 0.0}}),
                            .display = synthetic_image_error({{"flip_mean", flip}, {"rmse", 2.0 * flip}})};
    };
    CellError error;
    error.reference = picture(flip_mean);
    error.control = picture(flip_mean_of_packing);
    error.packing_share = flip_mean_of_packing / flip_mean;
    error.flip_mean_low = 0.9 * flip_mean;
    error.flip_mean_high = 1.1 * flip_mean;
    return error;
}

/// Frame times of a few rounds: median * noise of the frame * drift of the round.
class SyntheticClock {
  public:
    SyntheticClock(uint64_t seed, int rounds, double sigma, double drift) : random_(seed), sigma_(sigma) {
        for (int i = 0; i < rounds; ++i) drift_.push_back(1.0 + drift * std::sin(0.2 * i));
    }
    std::vector<int64_t> wall_ns(double median_ns) {
        std::vector<int64_t> result;
        for (const double drift : drift_) {
            result.push_back(std::llround(median_ns * drift * std::exp(sigma_ * normal())));
        }
        return result;
    }
    std::vector<int64_t> rounds() const {
        std::vector<int64_t> result(drift_.size());
        for (size_t i = 0; i < result.size(); ++i) result[i] = static_cast<int64_t>(i);
        return result;
    }

  private:
    double normal() {  // Box-Muller
        return std::sqrt(-2.0 * std::log(1.0 - random_.uniform())) *
               std::cos(2.0 * std::numbers::pi * random_.uniform());
    }

    Random random_;
    double sigma_;
    std::vector<double> drift_;
};

inline CellResult synthetic_cell(const CellParams& params, double median_ns, SyntheticClock& clock) {
    CellResult cell;
    cell.id = params.id();
    cell.group = params.group();
    cell.name = params.name();
    cell.params = params;
    cell.warnings = {"blended materials are drawn as opaque"};
    cell.work = CellWork{.draws = 3, .triangles = 36, .light_evaluations = std::nullopt, .skipped = {{"tangent", 1}}};
    if (!params.light_lists.empty()) {
        cell.light_lists = ListChoice{.asked = "auto", .used = "cpu", .why = "cpu 1 ms, compute 2 ms"};
        cell.work->light_hits = 300;
        cell.work->light_evaluations = 400;
        cell.work->false_positive_rate = 0.25;
        cell.work->list_entries = 77;
    }
    cell.first_frame_ns = 36'000'000;
    cell.stop_reason = "target_ci";
    cell.samples.round = clock.rounds();
    cell.samples.wall_ns = clock.wall_ns(median_ns);
    cell.samples.passes = {{"shade", {}}, {"gbuffer", {}}, {"unattributed", {}}};  // not in alphabetical order
    for (const int64_t wall_ns : cell.samples.wall_ns) {
        const int64_t gpu_ns = wall_ns - wall_ns / 10;
        cell.samples.cpu_ns.push_back(wall_ns / 10);
        cell.samples.gpu_ns.push_back(gpu_ns);
        cell.samples.passes[0].second.push_back(gpu_ns / 2);
        cell.samples.passes[1].second.push_back(gpu_ns / 4);
        cell.samples.passes[2].second.push_back(gpu_ns - gpu_ns / 2 - gpu_ns / 4);
    }
    // oct16 is off; everything else is as the control.
    cell.error = synthetic_error(params.layout == "oct16" ? 0.02 : 0.001, params.layout == "oct16" ? 0.019 : 0.0);
    if (!params.layout.empty()) {
        cell.error->fields = {{"normal", "deg", 0.02, 0.05, 0.1}, {"roughness", "abs", 0.0, 0.0, 0.0}};
    }
    return cell;
}

/// A frame was too slow to sample the cell.
inline void time_out(CellResult& cell) {
    cell.status = CellStatus::timeout;
    cell.reason = "a frame takes 3.2 s, more than the 1.5 s allowed";
    cell.too_slow_at_lights = cell.params.lights;
    cell.samples = {};
    cell.stop_reason.reset();
}

/// One group per light count, each with every arm and a twin of its first.
inline JournalContent synthetic_journal(const std::vector<std::pair<std::string, std::string>>& arms,
                                        const std::vector<int>& lights, const TimeModel& model, int rounds = 60,
                                        double sigma = 0.03, double drift = 0.3) {
    JournalContent journal{synthetic_run(static_cast<int64_t>(arms.size() * lights.size())),
                           synthetic_environment(),
                           synthetic_timer(),
                           {}};
    uint64_t seed = 1;
    for (const int count : lights) {
        SyntheticClock clock(seed++, rounds, sigma, drift);
        GroupResult group;
        for (const auto& [path, layout] : arms) {
            const CellParams params = arm(path, layout, count);
            group.cells.push_back(synthetic_cell(params, model(params), clock));
        }
        const CellResult& first = group.cells.front();
        group.group = first.group;
        group.noise = NoiseTwin{first.name, clock.rounds(), clock.wall_ns(model(first.params))};
        group.reference = {.key = "00aa",
                           .from_cache = false,
                           .seconds = 0.5,
                           .subpixel_bits = 8,
                           .control_exact = RelativeError{.median = 1e-7, .p99 = 1e-6, .max = 0.25, .above_1e4_px = 7},
                           .control_snapped = {}};
        group.wall_s = 2.0;
        group.frames_s = 1.75;
        journal.groups.push_back(group);
    }
    return journal;
}

}  // namespace lightsweep
