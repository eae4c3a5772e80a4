// What a run writes down: plain data as measured, nothing derived, and its JSON. Statistics are computed from it later
// (assemble.h). Times are integers in nanoseconds, one per frame.
#pragma once

#include "bench/plan/plan.h"

#include "bench/metrics/image_error.h"
#include "renderer/base/skips.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lightsweep {

/// Keeps the order in which keys are written: passes stay in the order in which they ran.
using Json = nlohmann::ordered_json;

/// The version of the structs below, which reports and journals share: their key "schema".
inline constexpr const char* kReportSchema = "lightsweep-report-2";

/// The metrics of a picture that can be bounded from above: those whose smaller values are better.
extern const std::vector<std::string> kBoundableMetrics;

/// A bound on one metric of the display picture against the reference.
struct ErrorLimit {
    std::string metric;  ///< one of kBoundableMetrics
    double limit = 0.0;
};

/// What was asked for, and by which program.
struct RunInfo {
    std::vector<std::string> arguments;
    std::string version;
    std::optional<std::string> git_commit;
    std::string build_type;
    int64_t seed = 0;
    std::string plan_hash;  ///< Plan::hash
    Shard shard;
    int64_t planned_cells = 0;  ///< in this shard
    int64_t plan_cells = 0;     ///< in all shards
    std::string started_at;     ///< ISO 8601, UTC
    std::optional<double> time_budget_s;
    double target_ci = 0.02;              ///< half width of a median's interval, as a fraction of it
    std::optional<double> max_frame_s{};  ///< arms whose frame takes longer are not sampled
    std::optional<ErrorLimit> max_error;  ///< asked: the cheapest arm within this error
    std::optional<double> max_time_ns;    ///< asked: the most exact arm within this time
};

struct Environment {
    std::string cpu;
    int64_t cores = 0;
    int64_t memory_bytes = 0;
    std::string os;
    std::string gl_provider;  ///< egl_device, egl_surfaceless, osmesa
    std::string gl_vendor;
    std::string gl_renderer;
    std::string gl_version;
    bool software = false;
    std::map<std::string, std::string> driver_variables;
    std::vector<std::string> workarounds;
    std::string compiler;
    std::string fingerprint;  ///< environment_fingerprint() of the rest
};

/// A hash of what changes times: everything but the memory's size, which varies between boots, and the fingerprint.
std::string environment_fingerprint(const Environment& environment);

/// What differs of that, as `cpu: "A" / "B", cores: 2 / 4`; empty when the fingerprints' contents agree.
std::string environment_difference(const Environment& a, const Environment& b);

/// One kind of known work, timed by one method and by the yardstick (the steady clock with glFinish).
struct TimerCase {
    std::string kind;
    std::vector<int64_t> target_px;  ///< width, height
    int64_t framebuffers = 1;
    std::vector<int64_t> work;  ///< multiples of the unit of work
    std::vector<int64_t> measured_ns;
    std::vector<int64_t> yardstick_ns;
    std::optional<double> ratio;      ///< measured over yardstick
    std::optional<double> linearity;  ///< R^2 of measured time over work
};

struct TimerMethodReport {
    std::string method;
    bool accepted = false;
    std::string why;
    std::optional<int64_t> overhead_ns;
    std::vector<TimerCase> cases;
};

/// The self-test's verdict on every way to time the GPU.
struct TimerReport {
    std::string method;   ///< the one in use
    bool forced = false;  ///< by the user, against or without the verdict
    std::string why;
    std::vector<TimerMethodReport> methods;
};

enum class CellStatus { ok, skipped, invalid, error, timeout, crashed };
extern const std::vector<std::string> kCellStatusNames;  ///< by value

struct CellWork {
    int64_t draws = 0;
    int64_t triangles = 0;
    int64_t instances_drawn = 0;
    int64_t instances_culled = 0;
    int64_t lights_drawn = 0;
    int64_t lights_culled = 0;
    std::optional<int64_t> light_evaluations;
    /// What the best path must evaluate: over the covered pixels, the lights that reach the surface there.
    std::optional<int64_t> light_hits{};
    /// 1 - light_hits / light_evaluations: the share of evaluations at which the light does not reach what is seen,
    /// those of hidden fragments among them. Below 0 where a layout loses pixels.
    std::optional<double> false_positive_rate{};
    std::optional<int64_t> list_entries{};  ///< of all cells' light lists; of paths that have some
    int64_t gbuffer_bytes_per_px = 0;
    int64_t target_bytes_per_px = 0;              ///< of all targets, the G-buffer among them
    std::optional<int64_t> moved_bytes_per_px{};  ///< CompiledPath::moved_bytes_per_pixel
    int64_t memory_bytes = 0;
    std::map<std::string, int64_t> skipped;  ///< what was not needed, counted by kind
};

/// One element per frame, in the order taken; all arrays are equally long.
struct Samples {
    std::vector<int64_t> round;    ///< the frame's round of the interleaving: frames of one round are paired
    std::vector<int64_t> cpu_ns;   ///< to build the frame
    std::vector<int64_t> gpu_ns;   ///< all passes
    std::vector<int64_t> wall_ns;  ///< from the start of building to the finished picture
    /// By pass, in the order run; with `unattributed` they sum to gpu_ns in each frame.
    std::vector<std::pair<std::string, std::vector<int64_t>>> passes;

    size_t count() const { return wall_ns.size(); }
};

/// How far a picture is from another: what `lightsweep diff` says of the EXR files, and of what a display shows.
struct PictureError {
    ImageError hdr;      ///< of the linear image
    ImageError display;  ///< after tone mapping, before its rounding to 8 bits
};

/// How far one field of the surface, as shading reads it, is from the reference's surface, over the covered pixels.
struct FieldError {
    std::string field;  ///< normal, position, base_color, specular, roughness, metallic, emissive
    std::string unit;   ///< deg, rel (to the distance from the eye, to the radiance), abs (largest channel)
    double mean = 0.0;
    double p99 = 0.0;
    double max = 0.0;
};

struct CellError {
    std::optional<PictureError> reference;  ///< against the reference: all of the error
    std::optional<PictureError> control;    ///< against the control arm: what packing alone does
    /// The packing's share of the squared error of display values against the reference: <e, p> / <e, e> with e this
    /// picture less the reference and p this picture less the control's. The control's own error has the rest.
    std::optional<double> packing_share;
    /// Ends of the interval (kIntervalLevel) of reference.display's flip_mean, from the means of 64 equal regions.
    std::optional<double> flip_mean_low, flip_mean_high;
    std::vector<FieldError> fields;  ///< of a path with a layout
    /// Pixels that only one of layout and reference takes for covered, or whose decoded values are not finite.
    int64_t lost_px = 0;
};

/// A distribution of |v - r| / |r| (per pixel, largest channels) over the covered pixels.
struct RelativeError {
    double median = 0.0;
    double p99 = 0.0;
    double max = 0.0;
    int64_t above_1e4_px = 0;  ///< pixels above 1e-4
};

/// The reference that a group's cells are compared with, and how far 32-bit arithmetic alone is from it.
struct GroupReference {
    std::string key;  ///< of the cache
    bool from_cache = false;
    double seconds = 0.0;                          ///< to compute, or to read
    int64_t subpixel_bits = 0;                     ///< GL_SUBPIXEL_BITS of the device
    std::optional<RelativeError> control_exact;    ///< the control arm against the reference
    std::optional<RelativeError> control_snapped;  ///< against one whose triangles are snapped to that grid
};

/// Who built the light lists of a cell.
struct ListChoice {
    std::string asked;  ///< one of kLightListBuilders
    std::string used;   ///< cpu or compute
    std::string why;
};

/// What `path=auto` came to.
struct PathChoice {
    std::string path;
    std::string why;
    std::map<std::string, double> expected_ns;  ///< by path, by the cost model
    /// By path, of those that may be the fastest by what the model knows: medians of a few frames.
    std::map<std::string, double> tried_ns;
};

/// What `skip=auto` came to.
struct SkipChoice {
    std::string skip;  ///< SkipSet::text()
    std::string why;
    /// By skip, of those that were tried: time of paired frames with it over without, all else equal.
    std::map<std::string, double> tried_ratio;
};

/// That a cell shows the picture of a cell of its group that differs from it in skips alone.
struct SkipProof {
    std::string compared_with;  ///< id of that cell: the first of its kind in the group, or that of skip=none
    bool same_bits = false;     ///< of the linear HDR picture, as all of this
    double max_abs = 0.0;       ///< |a - b|, largest channel; not finite where only one of a and b is
    double max_rel = 0.0;       ///< |a - b| / max(|a|, |b|), the same
    int64_t differing_px = 0;   ///< in some bit
};

struct CellResult {
    std::string id;     ///< CellParams::id() of the planned cell
    std::string group;  ///< CellParams::group() of the planned cell
    std::string name;   ///< CellParams::name() of the planned cell
    CellParams params;  ///< with the scene's own light count and overlap filled in, where the scene could be loaded
    CellStatus status = CellStatus::ok;
    std::optional<std::string> reason;  ///< of any status but ok
    /// A frame of this arm takes longer than RunInfo::max_frame_s with so many lights: its own count where the status
    /// is timeout, a smaller one where it was skipped for that.
    std::optional<int64_t> too_slow_at_lights{};
    std::vector<std::string> warnings;
    std::optional<ListChoice> light_lists{};  ///< of paths that have some, once drawn
    std::optional<PathChoice> auto_path{};    ///< of path=auto
    std::optional<SkipChoice> auto_skip{};    ///< of skip=auto
    std::optional<std::string> work_key{};    ///< Arm::work_key, once drawn: equal keys are the same work
    /// The id of the cell whose samples these are, since it is the same work (Skip::cells). Of this run, maybe of
    /// another group.
    std::optional<std::string> shared_with{};
    std::optional<SkipProof> skip_proof{};
    std::optional<CellWork> work;
    std::optional<int64_t> first_frame_ns;   ///< with the compiling of shaders
    std::optional<std::string> stop_reason;  ///< why sampling ended: target_ci, budget, ...
    Samples samples;
    std::optional<CellError> error;

    /// It may be compared with others.
    bool measured() const { return status == CellStatus::ok && samples.count() > 0; }
    /// Its skips as they were drawn: those of `auto_skip`, or of `params`. Nothing where nothing was decided.
    std::optional<SkipSet> skips() const { return parse_skips(auto_skip ? auto_skip->skip : params.skip); }
};

/// The same arm a second time in the same rounds: its ratio to itself is the noise.
struct NoiseTwin {
    std::string arm;  ///< the cell's name
    std::vector<int64_t> round;
    std::vector<int64_t> wall_ns;
};

struct GroupResult {
    std::string group;
    std::vector<CellResult> cells;
    std::optional<NoiseTwin> noise;
    std::optional<GroupReference> reference;
    double wall_s = 0.0;    ///< since the group before was written, or since the program started
    double frames_s = 0.0;  ///< of it in frames: sampled, or warm-up
};

/// Strict JSON: a number that is not finite becomes null. Defined for the structs above that a file holds whole.
template <typename Record>
Json to_json(const Record& record);

/// The inverse; null in a number is NaN. Unknown keys are ignored. Throws InputError with `where` and the JSON pointer.
template <typename Record>
Record from_json(const Json& json, const std::string& where);

/// Throws InputError, with both versions, unless `schema` is kReportSchema.
void require_schema(const Json& schema, const std::string& where);

/// The text of a file: indented, but a list of plain values on one line. Bytes that are not UTF-8 become U+FFFD.
std::string report_text(const Json& json);
/// The same on one line, without its end.
std::string line_text(const Json& json);

}  // namespace lightsweep
