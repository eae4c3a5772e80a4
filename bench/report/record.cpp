#include "bench/report/record.h"

#include "bench/report/json_codec.h"

#include "renderer/base/hash.h"
#include "renderer/base/names.h"

#include <algorithm>

namespace lightsweep {

const std::vector<std::string> kBoundableMetrics{"flip_mean", "rmse", "mrse", "max_abs"};
const std::vector<std::string> kCellStatusNames{"ok", "skipped", "invalid", "error", "timeout", "crashed"};

// --- The fields of each struct and their keys, once for both directions. `T` is the struct, const or not. ---
namespace {

template <typename T, typename Record>
concept Is = std::same_as<std::remove_const_t<T>, Record>;

}  // namespace

void visit_fields(Is<Shard> auto& r, auto visit) {
    visit("index", r.index);
    visit("count", r.count);
}

void visit_fields(Is<RunInfo> auto& r, auto visit) {
    visit("arguments", r.arguments);
    visit("version", r.version);
    visit("git_commit", r.git_commit);
    visit("build_type", r.build_type);
    visit("seed", r.seed);
    visit("plan_hash", r.plan_hash);
    visit("shard", r.shard);
    visit("planned_cells", r.planned_cells);
    visit("plan_cells", r.plan_cells);
    visit("started_at", r.started_at);
    visit("time_budget_s", r.time_budget_s);
    visit("target_ci", r.target_ci);
    visit("max_frame_s", r.max_frame_s);
    visit("max_error", r.max_error);
    visit("max_time_ns", r.max_time_ns);
}

void visit_fields(Is<Environment> auto& r, auto visit) {
    visit("cpu", r.cpu);
    visit("cores", r.cores);
    visit("memory_bytes", r.memory_bytes);
    visit("os", r.os);
    visit("gl_provider", r.gl_provider);
    visit("gl_vendor", r.gl_vendor);
    visit("gl_renderer", r.gl_renderer);
    visit("gl_version", r.gl_version);
    visit("software", r.software);
    visit("driver_variables", r.driver_variables);
    visit("workarounds", r.workarounds);
    visit("compiler", r.compiler);
    visit("fingerprint", r.fingerprint);
}

void visit_fields(Is<TimerCase> auto& r, auto visit) {
    visit("kind", r.kind);
    visit("target_px", r.target_px);
    visit("framebuffers", r.framebuffers);
    visit("work", r.work);
    visit("measured_ns", r.measured_ns);
    visit("yardstick_ns", r.yardstick_ns);
    visit("ratio", r.ratio);
    visit("linearity", r.linearity);
}

void visit_fields(Is<TimerMethodReport> auto& r, auto visit) {
    visit("method", r.method);
    visit("accepted", r.accepted);
    visit("why", r.why);
    visit("overhead_ns", r.overhead_ns);
    visit("cases", r.cases);
}

void visit_fields(Is<TimerReport> auto& r, auto visit) {
    visit("method", r.method);
    visit("forced", r.forced);
    visit("why", r.why);
    visit("methods", r.methods);
}

void visit_fields(Is<CellWork> auto& r, auto visit) {
    visit("draws", r.draws);
    visit("triangles", r.triangles);
    visit("instances_drawn", r.instances_drawn);
    visit("instances_culled", r.instances_culled);
    visit("lights_drawn", r.lights_drawn);
    visit("lights_culled", r.lights_culled);
    visit("light_evaluations", r.light_evaluations);
    visit("light_hits", r.light_hits);
    visit("false_positive_rate", r.false_positive_rate);
    visit("list_entries", r.list_entries);
    visit("gbuffer_bytes_per_px", r.gbuffer_bytes_per_px);
    visit("target_bytes_per_px", r.target_bytes_per_px);
    visit("moved_bytes_per_px", r.moved_bytes_per_px);
    visit("memory_bytes", r.memory_bytes);
    visit("skipped", r.skipped);
}

void visit_fields(Is<Samples> auto& r, auto visit) {
    visit("round", r.round);
    visit("cpu_ns", r.cpu_ns);
    visit("gpu_ns", r.gpu_ns);
    visit("wall_ns", r.wall_ns);
    visit("passes", r.passes);
}

void visit_fields(Is<PictureError> auto& r, auto visit) {
    visit("hdr", r.hdr);
    visit("display", r.display);
}

void visit_fields(Is<CellError> auto& r, auto visit) {
    visit("reference", r.reference);
    visit("control", r.control);
    visit("packing_share", r.packing_share);
    visit("flip_mean_low", r.flip_mean_low);
    visit("flip_mean_high", r.flip_mean_high);
    visit("fields", r.fields);
    visit("lost_px", r.lost_px);
}

void visit_fields(Is<RelativeError> auto& r, auto visit) {
    visit("median_rel", r.median);
    visit("p99_rel", r.p99);
    visit("max_rel", r.max);
    visit("above_1e4_px", r.above_1e4_px);
}

void visit_fields(Is<GroupReference> auto& r, auto visit) {
    visit("key", r.key);
    visit("from_cache", r.from_cache);
    visit("seconds", r.seconds);
    visit("subpixel_bits", r.subpixel_bits);
    visit("control_exact", r.control_exact);
    visit("control_snapped", r.control_snapped);
}

void visit_fields(Is<ListChoice> auto& r, auto visit) {
    visit("asked", r.asked);
    visit("used", r.used);
    visit("why", r.why);
}

void visit_fields(Is<PathChoice> auto& r, auto visit) {
    visit("path", r.path);
    visit("why", r.why);
    visit("expected_ns", r.expected_ns);
    visit("tried_ns", r.tried_ns);
}

void visit_fields(Is<SkipChoice> auto& r, auto visit) {
    visit("skip", r.skip);
    visit("why", r.why);
    visit("tried_ratio", r.tried_ratio);
}

void visit_fields(Is<SkipProof> auto& r, auto visit) {
    visit("compared_with", r.compared_with);
    visit("same_bits", r.same_bits);
    visit("max_abs", r.max_abs);
    visit("max_rel", r.max_rel);
    visit("differing_px", r.differing_px);
}

void visit_fields(Is<CellResult> auto& r, auto visit) {
    visit("id", r.id);
    visit("group", r.group);
    visit("name", r.name);
    visit("params", r.params);
    visit("status", r.status);
    visit("reason", r.reason);
    visit("too_slow_at_lights", r.too_slow_at_lights);
    visit("warnings", r.warnings);
    visit("light_lists", r.light_lists);
    visit("auto_path", r.auto_path);
    visit("auto_skip", r.auto_skip);
    visit("work_key", r.work_key);
    visit("shared_with", r.shared_with);
    visit("skip_proof", r.skip_proof);
    visit("work", r.work);
    visit("first_frame_ns", r.first_frame_ns);
    visit("stop_reason", r.stop_reason);
    visit("samples", r.samples);
    visit("error", r.error);
}

void visit_fields(Is<NoiseTwin> auto& r, auto visit) {
    visit("arm", r.arm);
    visit("round", r.round);
    visit("wall_ns", r.wall_ns);
}

void visit_fields(Is<GroupResult> auto& r, auto visit) {
    visit("group", r.group);
    visit("wall_s", r.wall_s);
    visit("frames_s", r.frames_s);
    visit("noise", r.noise);
    visit("reference", r.reference);
    visit("cells", r.cells);
}

// --- Structs whose JSON is not field by field. ---
namespace codec {

template <>
struct Codec<CellStatus> {
    static Json encode(CellStatus status) { return kCellStatusNames[static_cast<size_t>(status)]; }
    static CellStatus decode(const Json& json, const std::string& where) {
        const auto name = codec::decode<std::string>(json, where);
        const auto found = std::find(kCellStatusNames.begin(), kCellStatusNames.end(), name);
        if (found == kCellStatusNames.end()) throw InputError(where, unknown_name("status", name, kCellStatusNames));
        return static_cast<CellStatus>(found - kCellStatusNames.begin());
    }
};

template <>
struct Codec<ErrorLimit> {
    static Json encode(const ErrorLimit& limit) {
        return {{"metric", limit.metric}, {"limit", codec::encode(limit.limit)}};
    }
    static ErrorLimit decode(const Json& json, const std::string& where) {
        ErrorLimit result{.metric = member<std::string>(json, "metric", where),
                          .limit = member<double>(json, "limit", where)};
        if (std::ranges::find(kBoundableMetrics, result.metric) == kBoundableMetrics.end()) {
            throw InputError(where + "/metric", unknown_name("metric", result.metric, kBoundableMetrics));
        }
        if (!(result.limit >= 0.0)) throw InputError(where + "/limit", "a number from 0 was expected");
        return result;
    }
};

// The fixed radius regime is null and so is a path without layout or light lists: a reader need not know our own
// markers for them.
template <>
struct Codec<CellParams> {
    static Json encode(const CellParams& cell) {
        return {{"scene", cell.scene},
                {"lights", codec::encode(cell.lights)},
                {"width_px", cell.width},
                {"height_px", cell.height},
                {"overlap", cell.overlap.value_or(0.0) > 0.0 ? Json(*cell.overlap) : Json(nullptr)},
                {"path", cell.path},
                {"layout", or_null(cell.layout)},
                {"light_lists", or_null(cell.light_lists)},
                {"hdr", cell.hdr},
                {"skip", cell.skip},
                {"guards", cell.guards},
                {"sums", cell.sums}};
    }
    static CellParams decode(const Json& json, const std::string& where) {
        CellParams cell;
        cell.scene = member<std::string>(json, "scene", where);
        cell.lights = member<std::optional<int>>(json, "lights", where);
        cell.width = member<int>(json, "width_px", where);
        cell.height = member<int>(json, "height_px", where);
        cell.overlap = member<std::optional<double>>(json, "overlap", where).value_or(0.0);
        cell.path = member<std::string>(json, "path", where);
        cell.layout = member<std::optional<std::string>>(json, "layout", where).value_or("");
        cell.light_lists = member<std::optional<std::string>>(json, "light_lists", where).value_or("");
        cell.hdr = member<std::string>(json, "hdr", where);
        cell.skip = member<std::optional<std::string>>(json, "skip", where).value_or(kSkipEverything);
        cell.guards = member<std::optional<std::string>>(json, "guards", where).value_or(kGuards.front());
        cell.sums = member<std::optional<std::string>>(json, "sums", where).value_or(kSums.front());
        return cell;
    }
};

template <>
struct Codec<ImageError> {
    static Json encode(const ImageError& error) { return lightsweep::to_json(error); }
    static ImageError decode(const Json& json, const std::string& where) {
        ImageError error;
        for (const std::string_view key : metric_value_keys()) {
            error.values.push_back(member<std::optional<double>>(json, std::string(key), where));
        }
        error.identical = member<bool>(json, "identical", where);
        return error;
    }
};

// {"normal": {"mean_deg": ..., "p99_deg": ..., "max_deg": ...}, ...}: the unit stands in the keys.
template <>
struct Codec<std::vector<FieldError>> {
    static Json encode(const std::vector<FieldError>& fields) {
        Json json = Json::object();
        for (const auto& f : fields) {
            json[f.field] = {{"mean_" + f.unit, codec::encode(f.mean)},
                             {"p99_" + f.unit, codec::encode(f.p99)},
                             {"max_" + f.unit, codec::encode(f.max)}};
        }
        return json;
    }
    static std::vector<FieldError> decode(const Json& json, const std::string& where) {
        if (!json.is_object()) refuse(json, where, "an object");
        std::vector<FieldError> fields;
        for (const auto& [field, value] : json.items()) {
            const std::string place = where + "/" + field;
            const std::string unit = unit_of_mean(value, place);
            fields.push_back({.field = field,
                              .unit = unit,
                              .mean = member<double>(value, "mean_" + unit, place),
                              .p99 = member<double>(value, "p99_" + unit, place),
                              .max = member<double>(value, "max_" + unit, place)});
        }
        return fields;
    }

  private:
    static std::string unit_of_mean(const Json& json, const std::string& where) {
        constexpr std::string_view kPrefix = "mean_";
        if (!json.is_object()) refuse(json, where, "an object");
        for (const auto& [key, value] : json.items()) {
            if (key.starts_with(kPrefix)) return key.substr(kPrefix.size());
        }
        throw InputError(where, "the key 'mean_<unit>' is missing");
    }
};

}  // namespace codec

template <typename Record>
Json to_json(const Record& record) {
    return codec::encode(record);
}

template <typename Record>
Record from_json(const Json& json, const std::string& where) {
    return codec::decode<Record>(json, where);
}

template Json to_json(const ErrorLimit&);
template Json to_json(const RunInfo&);
template Json to_json(const Environment&);
template Json to_json(const TimerReport&);
template Json to_json(const CellParams&);
template Json to_json(const SkipProof&);
template Json to_json(const CellResult&);
template Json to_json(const NoiseTwin&);
template Json to_json(const GroupReference&);
template Json to_json(const GroupResult&);
template RunInfo from_json(const Json&, const std::string&);
template Environment from_json(const Json&, const std::string&);
template TimerReport from_json(const Json&, const std::string&);
template CellResult from_json(const Json&, const std::string&);
template GroupResult from_json(const Json&, const std::string&);

namespace {

Json timing_environment(const Environment& environment) {
    Json json = to_json(environment);
    json.erase("memory_bytes");
    json.erase("fingerprint");
    return json;
}

void append_text(std::string& text, const Json& json, size_t depth) {
    const auto is_plain = [](const Json& element) { return !element.is_structured(); };
    if (!json.is_structured() || json.empty() || (json.is_array() && std::all_of(json.begin(), json.end(), is_plain))) {
        text += line_text(json);
        return;
    }
    const std::string indent(depth + 1, ' ');
    text += json.is_object() ? '{' : '[';
    const char* separator = "\n";
    for (const auto& [key, value] : json.items()) {
        text += separator + indent;
        if (json.is_object()) text += line_text(key) + ": ";
        append_text(text, value, depth + 1);
        separator = ",\n";
    }
    text += '\n' + std::string(depth, ' ') + (json.is_object() ? '}' : ']');
}

}  // namespace

std::string environment_fingerprint(const Environment& environment) {
    return hash_hex(line_text(timing_environment(environment)));
}

std::string environment_difference(const Environment& a, const Environment& b) {
    const Json json_a = timing_environment(a);
    const Json json_b = timing_environment(b);
    std::string text;
    for (const auto& [key, value] : json_a.items()) {
        if (value == json_b.at(key)) continue;
        text += (text.empty() ? "" : ", ") + key + ": " + line_text(value) + " / " + line_text(json_b.at(key));
    }
    return text;
}

void require_schema(const Json& schema, const std::string& where) {
    if (schema == kReportSchema) return;
    throw InputError(where, "this program reads \"" + std::string(kReportSchema) + "\", not " + line_text(schema) +
                                "; measure again, or use the program that wrote it");
}

std::string line_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string report_text(const Json& json) {
    std::string text;
    append_text(text, json, 0);
    return text + '\n';
}

}  // namespace lightsweep
