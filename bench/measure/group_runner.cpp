#include "bench/measure/group_runner.h"

#include "bench/measure/calibrate.h"
#include "bench/measure/light_hits.h"
#include "bench/measure/list_probe.h"
#include "bench/measure/trial.h"
#include "bench/stats/quantile.h"
#include "bench/stats/schedule.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/gl/context.h"
#include "renderer/paths/paths.h"

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
constexpr size_t kMostLightsOfPlainControl = 256;

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

CellWork cell_work(const Arm& arm, const Subject& subject) {
    const FrameWork& work = arm.frame().work;
    CellWork result;
    result.draws = static_cast<int64_t>(work.draws);
    result.triangles = static_cast<int64_t>(work.triangles);
    result.instances_drawn = static_cast<int64_t>(work.instances_drawn);
    result.instances_culled = static_cast<int64_t>(work.instances_culled);
    result.lights_drawn = static_cast<int64_t>(work.lights_drawn);
    result.lights_culled = static_cast<int64_t>(work.lights_culled);
    result.gbuffer_bytes_per_px = arm.setup().layout.targets.empty() ? 0 : arm.setup().layout.bytes_per_pixel();
    result.target_bytes_per_px = arm.path().bytes_per_pixel();
    result.moved_bytes_per_px = arm.path().moved_bytes_per_pixel();
    result.memory_bytes = static_cast<int64_t>(arm.path().memory_bytes() + subject.scene.memory_bytes());
    return result;
}

// Another path's cell, without what that path does not use.
CellParams with_path(CellParams cell, const std::string& path) {
    cell.path = path;
    const PathInfo& info = find_path(path);
    if (!info.uses_layout) cell.layout.clear();
    if (!info.uses_light_lists) cell.light_lists.clear();
    return cell;
}

// Draws another frame.
void count_lights(Arm& arm, std::optional<int64_t> light_hits, CellWork& work) {
    const auto evaluations = static_cast<int64_t>(arm.count_light_evaluations());
    work.light_evaluations = evaluations;
    if (light_hits && evaluations > 0) {
        work.false_positive_rate = 1.0 - static_cast<double>(*light_hits) / static_cast<double>(evaluations);
    }
    if (const LightListService* lists = arm.path().light_lists()) {
        work.list_entries = static_cast<int64_t>(lists->read().indices.size());
    }
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

}  // namespace

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

// A place in the round: a cell's arm, or the twin of the first one.
struct GroupRunner::Slot {
    Arm* arm = nullptr;
    size_t cell = 0;
    bool twin = false;
    std::unique_ptr<Arm> owned;
};

// What the cells of a group are compared with, or why there is none.
struct GroupRunner::Truth {
    std::optional<Picture> control;
    std::optional<Reference> reference;
    std::optional<int64_t> light_hits;
    std::vector<std::string> failures;
    std::map<uint64_t, CellError> errors_of_picture;  // by a hash of its texels: many paths give the very same picture
};

CellParams control_cell(const CellParams& any_cell_of_group, size_t light_count) {
    const bool plain = light_count <= kMostLightsOfPlainControl;
    CellParams control = any_cell_of_group;
    control.path = plain ? "deferred" : "deferred_clustered";
    control.layout = "float32";
    control.light_lists = plain ? "" : "cpu";
    control.hdr = "rgba32f";
    return control;
}

GroupRunner::GroupRunner(SceneStore& scenes, std::string timer_method, const std::atomic<bool>& interrupted)
    : scenes_(&scenes), interrupted_(&interrupted), timer_(make_frame_timer(timer_method)) {}

void GroupRunner::remember(const GroupResult& group) {
    slow_arms_.remember(group);
    for (const auto& cell : group.cells) {
        const bool chosen = cell.light_lists && cell.light_lists->asked == kAutoLightLists;
        if (chosen && !auto_light_lists_) auto_light_lists_ = cell.light_lists;
    }
}

FrameSample GroupRunner::take(Arm& arm, GroupResult& result) {
    const FrameSample sample = arm.sample(*timer_);
    result.frames_s += static_cast<double>(sample.wall_ns) * kNsToS;
    return sample;
}

Picture GroupRunner::draw_control(const CellParams& cell, const Subject& subject, GroupResult& result) {
    const int64_t start = now_ns();
    Arm arm(control_cell(cell, subject.lights.size()), subject, buffers_, shapes_);
    arm.draw();
    result.frames_s += seconds_since(start);
    return picture_of(arm.hdr_image());
}

GroupRunner::Truth GroupRunner::find_truth(const CellParams& cell, const Subject& subject, GroupResult& result) {
    Truth truth;
    try {
        truth.control = draw_control(cell, subject, result);
    } catch (const std::exception& error) {
        truth.failures.push_back(std::string("no error against the control arm: ") + error.what());
    }
    try {
        references_.look_at(subject, buffers_, shapes_);
        truth.reference = references_.reference(subject);
        truth.light_hits = count_light_hits(references_.surfaces(), subject.lights, subject.scene.scene().camera.eye);
        const auto subpixel_bits = static_cast<int>(gl::Context::current()->limits().subpixel_bits);
        GroupReference& record = result.reference.emplace();
        record.key = truth.reference->key;
        record.from_cache = truth.reference->from_cache;
        record.seconds = truth.reference->seconds;
        record.subpixel_bits = subpixel_bits;
        if (truth.control) {
            const Reference snapped = references_.reference(subject, subpixel_bits);
            record.from_cache = record.from_cache && snapped.from_cache;
            record.seconds += snapped.seconds;
            const auto& surfaces = references_.surfaces();
            record.control_exact = relative_error(truth.reference->picture.hdr, truth.control->hdr, surfaces);
            record.control_snapped = relative_error(snapped.picture.hdr, truth.control->hdr, surfaces);
        }
    } catch (const std::exception& error) {
        truth.failures.push_back(std::string("no error against the reference: ") + error.what());
    }
    return truth;
}

CellParams GroupRunner::resolve(const CellParams& params, const Subject& subject, CellResult& cell) {
    CellParams drawn = params;
    if (params.light_lists == kAutoLightLists) {
        cell.light_lists = auto_light_lists();
        drawn.light_lists = cell.light_lists->used;
    }
    if (params.path == kAutoPath) {
        if (!costs_) throw InputError("path=auto", "no cost model; `lightsweep doctor --calibrate` measures one");
        cell.auto_path = choose_path(*costs_, cost_features(subject, buffers_, shapes_));
        const auto candidates = may_be_fastest(*costs_, *cell.auto_path);
        if (candidates.size() > 1) {
            std::vector<CellParams> cells;
            for (const auto& path : candidates) cells.push_back(with_path(drawn, path));
            const auto tried = try_arms(cells, subject, buffers_, shapes_);
            for (size_t i = 0; i < candidates.size(); ++i) {
                if (tried[i]) cell.auto_path->tried_ns[candidates[i]] = *tried[i];
            }
            decide_by_trial(*cell.auto_path);
        }
        drawn = with_path(drawn, cell.auto_path->path);
    }
    if (drawn.light_lists.empty()) {
        cell.light_lists.reset();
    } else if (params.light_lists != kAutoLightLists) {
        cell.light_lists = ListChoice{.asked = params.light_lists, .used = params.light_lists, .why = "asked for"};
    }
    return drawn;
}

// The one that is faster on this device; found out once.
const ListChoice& GroupRunner::auto_light_lists() {
    if (!auto_light_lists_) {
        const ListProbe probe = probe_light_lists();
        const std::string& used = list_builder_names()[static_cast<size_t>(probe.faster())];
        auto_light_lists_ = ListChoice{.asked = kAutoLightLists, .used = used, .why = probe.why()};
    }
    return *auto_light_lists_;
}

// Makes an arm ready: compiled, its work counted, its caches warm. One that is too slow is drawn and no more: the cell
// says so.
std::unique_ptr<Arm> GroupRunner::warm_up(const CellParams& params, const Subject& subject, const SamplingRules& rules,
                                          GroupResult& result, CellResult& cell) {
    const CellParams drawn = resolve(params, subject, cell);
    const int64_t start = now_ns();
    auto arm = std::make_unique<Arm>(drawn, subject, buffers_, shapes_);
    double frame_s = static_cast<double>(arm->sample(*timer_).wall_ns) * kNsToS;
    cell.first_frame_ns = now_ns() - start;
    result.frames_s += seconds_since(start);
    cell.work = cell_work(*arm, subject);
    if (frame_s > rules.max_frame_s && frame_s <= kSurelyTooSlow * rules.max_frame_s) {
        frame_s = static_cast<double>(take(*arm, result).wall_ns) * kNsToS;
    }
    if (frame_s > rules.max_frame_s) {
        cell.status = CellStatus::timeout;
        cell.reason = fmt::format("a frame takes {:.3g} s, more than the {:g} s allowed", frame_s, rules.max_frame_s);
        cell.too_slow_at_lights = cell.params.lights;
    }
    return arm;
}

// What is left to do before sampling.
void GroupRunner::settle(Arm& arm, const Truth& truth, GroupResult& result, CellResult& cell) {
    const int64_t start = now_ns();
    count_lights(arm, truth.light_hits, *cell.work);
    while (seconds_since(start) < kWarmUpSeconds) take(arm, result);
}

const LayoutError& GroupRunner::layout_error_of(const CellParams& params, const Arm& arm, const Subject& subject) {
    const Scene& scene = subject.scene.scene();
    // By the layout as the user named it: two files may have one key.
    const std::string key =
        fmt::format("{} {}x{} {}", scene.content_hash, subject.width, subject.height, params.layout);
    auto found = layout_errors_.find(key);
    if (found == layout_errors_.end()) {  // entered only when it is known: a failure must not leave an empty one
        const auto decoded = draw_decoded_surface(arm.setup(), subject, buffers_, shapes_);
        found = layout_errors_.emplace(key, layout_error(references_.surfaces(), decoded, subject.scene.needs())).first;
    }
    return found->second;
}

CellError GroupRunner::picture_errors(const Image& hdr, Truth& truth, const SamplingRules& rules, CellResult& cell) {
    const uint64_t hash =
        hash_bytes({reinterpret_cast<const char*>(hdr.rgb.data()), hdr.rgb.size() * sizeof(hdr.rgb[0])});
    const auto known = truth.errors_of_picture.find(hash);
    if (known != truth.errors_of_picture.end() && rules.maps_folder.empty()) return known->second;
    const Picture picture = picture_of(hdr);
    CellError error;
    if (truth.control) error.control = picture_error(*truth.control, picture, HdrFlip::leave_out);
    if (!truth.reference) return error;
    const Picture& reference = truth.reference->picture;
    error.reference = picture_error(reference, picture, HdrFlip::measure);
    if (truth.control) error.packing_share = packing_share(reference.display, truth.control->display, picture.display);
    const FlipMap map = ldr_flip(reference.display, picture.display);
    if (const auto interval = mean_interval(map)) {
        error.flip_mean_low = interval->low;
        error.flip_mean_high = interval->high;
    }
    if (!rules.maps_folder.empty()) {
        try {
            write_flip_map(map, rules.maps_folder / (cell.id + ".png"));
        } catch (const InputError& failure) {  // a full disk must not cost what is measured
            cell.warnings.push_back(std::string("no FLIP map: ") + failure.what());
        }
    }
    truth.errors_of_picture[hash] = error;
    return error;
}

CellError GroupRunner::cell_error(const Arm& arm, const Subject& subject, Truth& truth, const SamplingRules& rules,
                                  CellResult& cell) {
    CellError error = picture_errors(arm.hdr_image(), truth, rules, cell);
    if (!truth.reference) return error;
    if (!arm.setup().layout.targets.empty()) {
        try {
            const LayoutError& layout = layout_error_of(cell.params, arm, subject);
            error.fields = layout.fields;
            error.lost_px = layout.lost_px;
        } catch (const EnvironmentError& failure) {  // no room for the probe's targets: the arm itself can be timed
            cell.warnings.push_back(std::string("no errors of the fields: ") + failure.what());
        }
    }
    return error;
}

void GroupRunner::prepare(const PlanGroup& group, const Subject& subject, const SamplingRules& rules,
                          GroupResult& result, std::vector<Slot>& slots) {
    std::optional<Truth> truth;  // once a cell is drawn
    for (const auto& params : group.cells) {
        CellResult cell = new_cell(params, subject.scene.scene(), subject.lights.size());
        if (const auto slow = slow_arms_.find(cell.params)) {
            cell.status = CellStatus::skipped;
            cell.reason = slow->reason;
            cell.too_slow_at_lights = slow->lights;
            result.cells.push_back(std::move(cell));
            continue;
        }
        if (!truth) truth = find_truth(params, subject, result);
        const auto fail = [&](CellStatus status, const std::string& reason) {
            cell.status = status;
            cell.reason = reason;
            cell.too_slow_at_lights.reset();
            cell.work.reset();
            cell.error.reset();
        };
        try {
            auto arm = warm_up(params, subject, rules, result, cell);
            cell.error = cell_error(*arm, subject, *truth, rules, cell);
            cell.warnings.insert(cell.warnings.end(), truth->failures.begin(), truth->failures.end());
            cell.work->light_hits = truth->light_hits;
            const bool fast_enough = cell.status == CellStatus::ok;
            if (fast_enough) settle(*arm, *truth, result, cell);
            gl::Context::current()->throw_on_debug_errors(cell.name);
            if (fast_enough) {
                slots.push_back(
                    {.arm = arm.get(), .cell = result.cells.size(), .twin = false, .owned = std::move(arm)});
            }
        } catch (const InputError& error) {
            fail(CellStatus::invalid, error.what());
        } catch (const EnvironmentError& error) {
            fail(CellStatus::skipped, error.what());
        } catch (const std::exception& error) {
            fail(CellStatus::error, error.what());
        }
        result.cells.push_back(std::move(cell));
        if (*interrupted_) break;
    }
    if (slots.empty()) return;
    slots.push_back({.arm = slots.front().arm, .cell = slots.front().cell, .twin = true, .owned = {}});
}

std::string GroupRunner::sample_rounds(const SamplingRules& rules, int64_t start_ns, GroupResult& result,
                                       std::vector<Slot>& slots, const GroupProgress& progress) {
    const int64_t sampling_start_ns = now_ns();
    for (int round = 0;; ++round) {
        for (const size_t s : schedule(slots.size(), static_cast<size_t>(round))) {
            if (*interrupted_) return "interrupted";
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
    std::vector<Slot> slots;
    prepare(group, subject, rules, result, slots);
    remember(result);
    if (slots.empty()) return result;
    result.noise = NoiseTwin{.arm = result.cells[slots.front().cell].name, .round = {}, .wall_ns = {}};
    const std::string stop_reason = sample_rounds(rules, start_ns, result, slots, progress);
    for (const auto& slot : slots) {
        if (slot.twin) continue;
        result.cells[slot.cell].stop_reason = stop_reason;
        warn_of_impossible_times(result.cells[slot.cell]);
    }
    return result;
}

}  // namespace lightsweep
