#include "bench/measure/group_runner.h"

#include "bench/measure/cell_work.h"
#include "bench/measure/skip_proof.h"
#include "bench/measure/trial.h"
#include "bench/stats/quantile.h"
#include "bench/stats/schedule.h"
#include "renderer/base/error.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace lightsweep {
namespace {

constexpr double kNsToS = 1e-9;
// After the first frame: caches, buffers and the driver's own threads settle. A slow arm settles within its own frame.
constexpr double kWarmUpSeconds = 0.05;
constexpr double kOverrun = 1.5;  // of the time for a group, before its smallest number of rounds is given up
constexpr int kFewestRounds = 2;
// A first frame compiles shaders too: one over the limit is judged by a second one, unless it is so far over it.
constexpr double kSurelyTooSlow = 3.0;
constexpr const char* kInterruptedReason = "interrupted";

double seconds_since(int64_t start_ns) { return static_cast<double>(now_ns() - start_ns) * kNsToS; }

CellResult new_cell(const CellParams& params, const Scene& scene, size_t light_count) {
    CellResult cell;
    cell.id = params.id();
    cell.group = params.group();
    cell.name = params.name();
    cell.params = params;
    cell.params.lights = static_cast<int>(light_count);
    if (!cell.params.overlap) cell.params.overlap = scene.lights.default_overlap;
    cell.warnings = scene.warnings;
    return cell;
}

void fail(CellResult& cell, CellStatus status, const std::string& reason) {
    cell.status = status;
    cell.reason = reason;
    cell.too_slow_at_lights.reset();
    cell.work.reset();
    cell.work_key.reset();
    cell.shared_with.reset();
    cell.skip_proof.reset();
    cell.error.reset();
}

// False when it failed: the cell says why.
bool attempt(CellResult& cell, const std::function<void()>& action) {
    try {
        action();
        gl::Context::current()->throw_on_debug_errors(cell.name);
        return true;
    } catch (const InputError& error) {
        fail(cell, CellStatus::invalid, error.what());
    } catch (const EnvironmentError& error) {
        fail(cell, CellStatus::skipped, error.what());
    } catch (const std::exception& error) {
        fail(cell, CellStatus::error, error.what());
    }
    return false;
}

void append(const FrameSample& sample, int64_t round, const std::vector<std::string>& pass_names, Samples& samples) {
    if (samples.passes.empty()) {
        for (const auto& name : pass_names) samples.passes.push_back({name, {}});
        samples.passes.push_back({"unattributed", {}});
    }
    samples.round.push_back(round);
    samples.cpu_ns.push_back(sample.cpu_ns);
    samples.gpu_ns.push_back(sample.gpu.total_ns);
    samples.wall_ns.push_back(sample.wall_ns);
    for (size_t i = 0; i < pass_names.size(); ++i) samples.passes[i].second.push_back(sample.gpu.passes_ns[i]);
    samples.passes.back().second.push_back(sample.gpu.unattributed_ns);
}

// Whether the median is known to within `target` of itself.
bool tight(const std::vector<int64_t>& ns, double target) {
    const std::vector<double> values(ns.begin(), ns.end());
    const Interval interval = median_interval(values);
    if (!interval.low || !interval.high) return false;
    return *interval.high - *interval.low <= 2.0 * target * interval.estimate;
}

// Cells that were not sampled since another of their group is the same work.
void share_within(GroupResult& group) {
    for (auto& cell : group.cells) {
        if (!cell.shared_with) continue;
        const auto like = std::ranges::find(group.cells, *cell.shared_with, &CellResult::id);
        share(*like, cell);
    }
}

// The timer passed its test, but one frame of many may still be off: said, and not hidden.
void warn_of_impossible_times(CellResult& cell) {
    size_t count = 0;
    for (size_t i = 0; i < cell.samples.count(); ++i) {
        const int64_t gpu = cell.samples.gpu_ns[i];
        if (gpu <= 0 || gpu > cell.samples.wall_ns[i]) ++count;
    }
    if (count > 0) {
        cell.warnings.push_back(fmt::format("{} of {} frames have a gpu_ns that is not above 0 and below wall_ns",
                                            count, cell.samples.count()));
    }
}

}  // namespace

// A place in the round: a cell's arm, or the twin of the first one.
struct GroupRunner::Slot {
    Arm* arm = nullptr;
    size_t cell = 0;
    bool twin = false;
};

GroupRunner::GroupRunner(SceneStore& scenes, std::string timer_method, const std::atomic<bool>& interrupted)
    : scenes_(&scenes),
      interrupted_(&interrupted),
      timer_(make_frame_timer(timer_method)),
      truths_(buffers_, shapes_),
      choices_(buffers_, shapes_) {}

void GroupRunner::remember(const GroupResult& group) {
    slow_arms_.remember(group);
    choices_.remember(group);
    shared_work_.remember(group);
}

FrameSample GroupRunner::take(Arm& arm, GroupResult& result) {
    const FrameSample sample = arm.sample(*timer_);
    result.frames_s += static_cast<double>(sample.wall_ns) * kNsToS;
    return sample;
}

// Makes an arm ready: compiled, its work counted, its caches warm. One that is too slow is drawn and no more: the cell
// says so.
std::unique_ptr<Arm> GroupRunner::warm_up(const CellParams& params, const Subject& subject, const SamplingRules& rules,
                                          GroupResult& result, CellResult& cell) {
    const CellParams drawn = choices_.resolve(params, subject, cell);
    const int64_t start = now_ns();
    auto arm = std::make_unique<Arm>(drawn, subject, buffers_, shapes_);
    double frame_s = static_cast<double>(arm->sample(*timer_).wall_ns) * kNsToS;
    cell.first_frame_ns = now_ns() - start;
    result.frames_s += seconds_since(start);
    cell.work = cell_work(*arm, subject, drawn);
    cell.work_key = arm->work_key();
    if (frame_s > rules.max_frame_s && frame_s <= kSurelyTooSlow * rules.max_frame_s) {
        frame_s = static_cast<double>(take(*arm, result).wall_ns) * kNsToS;
    }
    if (frame_s > rules.max_frame_s) {
        cell.status = CellStatus::timeout;
        cell.reason = fmt::format("a frame takes {:.3g} s, more than the {:g} s allowed", frame_s, rules.max_frame_s);
        cell.too_slow_at_lights = cell.params.lights;
        return arm;
    }
    // The first frame hides nothing: pictures and work are to be those of the frames that are timed.
    const bool occludes = arm->setup().skips.has(Skip::occlusion) && subject.scene.needs().several_instances();
    for (int frame = 0; occludes && frame < kFramesToSettle; ++frame) take(*arm, result);
    cell.work = cell_work(*arm, subject, drawn);
    return arm;
}

// What is left to do before sampling.
void GroupRunner::settle(Arm& arm, const Truth& truth, GroupResult& result, CellResult& cell) {
    const int64_t start = now_ns();
    while (seconds_since(start) < kWarmUpSeconds) take(arm, result);
    count_lights(arm, truth.light_hits, *cell.work);
}

// A first frame of each cell; null where it cannot be drawn, or need not.
GroupRunner::Arms GroupRunner::draw_cells(const PlanGroup& group, const Subject& subject, const SamplingRules& rules,
                                          GroupResult& result) {
    Arms arms;
    SkipProofs proofs(group.cells);
    for (const auto& params : group.cells) {
        if (*interrupted_ && !result.cells.empty()) break;
        CellResult& cell = result.cells.emplace_back(new_cell(params, subject.scene.scene(), subject.lights.size()));
        std::unique_ptr<Arm>& arm = arms.emplace_back();
        if (const auto slow = slow_arms_.find(cell.params)) {
            cell.status = CellStatus::skipped;
            cell.reason = slow->reason;
            cell.too_slow_at_lights = slow->lights;
            continue;
        }
        const bool drawn = attempt(cell, [&] {
            arm = warm_up(params, subject, rules, result, cell);
            if (proofs.wants(params)) cell.skip_proof = proofs.prove(cell, arm->hdr_image());
        });
        if (!drawn) arm.reset();
    }
    return arms;
}

// Compares what was drawn with the truth, and makes ready what is to be sampled: of the others no arm is left.
void GroupRunner::prepare(Arms& arms, const Subject& subject, const SamplingRules& rules, GroupResult& result) {
    const auto first = std::ranges::find_if(arms, [](const auto& arm) { return arm != nullptr; });
    if (first == arms.end()) return;
    Truth truth = truths_.find(result.cells[static_cast<size_t>(first - arms.begin())].params, subject, result);
    for (size_t i = 0; i < arms.size(); ++i) {
        if (!arms[i]) continue;
        CellResult& cell = result.cells[i];
        const bool done = attempt(cell, [&] {
            cell.error = truths_.error(*arms[i], subject, rules.maps_folder, truth, cell);
            cell.warnings.insert(cell.warnings.end(), truth.failures.begin(), truth.failures.end());
            cell.work->light_hits = truth.light_hits;
            if (cell.status != CellStatus::ok) return;
            for (size_t j = 0; j < i && !cell.shared_with; ++j) {
                if (arms[j] && same_work(result.cells[j], cell)) cell.shared_with = result.cells[j].id;
            }
            if (!cell.shared_with) settle(*arms[i], truth, result, cell);
        });
        if (!done || cell.status != CellStatus::ok || cell.shared_with) arms[i].reset();
        if (*interrupted_) return;
    }
}

std::string GroupRunner::sample_rounds(const SamplingRules& rules, int64_t start_ns, GroupResult& result,
                                       std::vector<Slot>& slots, const GroupProgress& progress) {
    const int64_t sampling_start_ns = now_ns();
    for (int round = 0;; ++round) {
        for (const size_t s : schedule(slots.size(), static_cast<size_t>(round))) {
            if (*interrupted_) return kInterruptedReason;
            const Slot& slot = slots[s];
            const FrameSample sample = take(*slot.arm, result);
            if (slot.twin) {
                result.noise->round.push_back(round);
                result.noise->wall_ns.push_back(sample.wall_ns);
            } else {
                append(sample, round, slot.arm->path().pass_names(), result.cells[slot.cell].samples);
            }
        }
        const double elapsed = seconds_since(start_ns);
        const int done = round + 1;
        progress(std::max(elapsed / rules.seconds, static_cast<double>(done) / rules.max_rounds));
        const double next_round = seconds_since(sampling_start_ns) / done;
        if (elapsed + next_round > kOverrun * rules.seconds && done >= kFewestRounds) return "budget";
        if (done < rules.min_rounds) continue;
        const bool all_tight = std::all_of(slots.begin(), slots.end(), [&](const Slot& slot) {
            return slot.twin || tight(result.cells[slot.cell].samples.wall_ns, rules.target_ci);
        });
        // Only after whole cycles of the schedule, as long as there is time: then every place was taken equally often.
        if (all_tight && static_cast<size_t>(done) % rounds_per_cycle(slots.size()) == 0) return "target_ci";
        if (elapsed >= rules.seconds) return "budget";
        if (done >= rules.max_rounds) return "max_rounds";
    }
}

GroupResult GroupRunner::run(const PlanGroup& group, const SamplingRules& rules, const GroupProgress& progress) {
    GroupResult result = measure(group, rules, progress);
    remember(result);
    return result;
}

GroupResult GroupRunner::measure(const PlanGroup& group, const SamplingRules& rules, const GroupProgress& progress) {
    const int64_t start_ns = now_ns();
    GroupResult result;
    result.group = group.key;
    const CellParams& first = group.cells.front();
    const GpuScene& gpu_scene = scenes_->gpu_scene(first.scene);
    const Scene& scene = gpu_scene.scene();
    const Subject subject{.scene = gpu_scene,
                          .lights = make_lights(scene, first.lights.value_or(scene.lights.default_count),
                                                {first.overlap.value_or(scene.lights.default_overlap)}),
                          .width = first.width,
                          .height = first.height};
    Arms arms = draw_cells(group, subject, rules, result);
    // A map is asked for of each cell.
    if (rules.maps_folder.empty() && shared_work_.share_group(result)) return result;
    prepare(arms, subject, rules, result);
    std::vector<Slot> slots;
    for (size_t i = 0; i < arms.size(); ++i) {
        if (arms[i]) slots.push_back({.arm = arms[i].get(), .cell = i});
    }
    if (slots.empty()) return result;
    slots.push_back({.arm = slots.front().arm, .cell = slots.front().cell, .twin = true});
    result.noise = NoiseTwin{.arm = result.cells[slots.front().cell].name, .round = {}, .wall_ns = {}};
    const std::string stop_reason = sample_rounds(rules, start_ns, result, slots, progress);
    for (const auto& slot : slots) {
        if (slot.twin) continue;
        result.cells[slot.cell].stop_reason = stop_reason;
        warn_of_impossible_times(result.cells[slot.cell]);
    }
    if (stop_reason != kInterruptedReason) share_within(result);
    return result;
}

}  // namespace lightsweep
