#include "bench/stress/stress_report.h"

#include "bench/report/json_codec.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace lightsweep {
namespace {

using codec::encode;

// How many values of `axis` the case tries where `fixed` is as in this arm.
size_t values_tried(const std::vector<StressResult>& results, const StressArm& arm, std::string_view axis,
                    std::string_view fixed) {
    std::set<std::string> values;
    for (const StressResult& result : results) {
        if (result.arm.get(fixed) == arm.get(fixed)) values.insert(result.arm.get(axis));
    }
    return values.size();
}

Json axes_json(const StressArm& arm) {
    Json axes = Json::object();
    for (const auto& [axis, value] : arm.choices()) axes[axis] = value;
    return axes;
}

Json parameter_json(const std::optional<StressParameter>& parameter) {
    if (!parameter) return nullptr;
    return {{"name", parameter->name}, {"unit", parameter->unit}, {"easy", parameter->easy}, {"hard", parameter->hard}};
}

std::optional<double> ratio_of(const StressMeasurement& found) {
    if (!found.law || *found.law == 0.0) return {};
    return found.error / *found.law;
}

Json point_json(const StressPoint& point) {
    return {{"parameter", encode(point.parameter)},
            {"measured", encode(point.found.error)},
            {"predicted", encode(point.found.law)},
            {"bound", encode(point.bound)},
            {"status", word(point.verdict)}};
}

// Where no point could be tried every number is null.
Json numbers_json(const StressResult& result) {
    const auto number = [&](const Json& value) { return result.curve.empty() ? Json(nullptr) : value; };
    const StressPoint& worst = result.worst;
    return {{"breakdown", number(encode(result.breakdown))},
            {"at", result.of->parameter ? number(encode(worst.parameter)) : Json(nullptr)},
            {"measured", number(encode(worst.found.error))},
            {"predicted", number(encode(worst.found.law))},
            {"ratio", number(encode(ratio_of(worst.found)))},
            {"bound", number(encode(worst.bound))},
            {"non_finite", number(worst.found.non_finite)}};
}

Json result_json(const StressResult& result, const std::vector<StressResult>& of_case) {
    const StressCase& stress_case = *result.of;
    Json json = {{"id", stress_case.id},
                 {"summary", stress_case.summary},
                 {"measures", stress_case.measures},
                 {"unit", stress_case.unit},
                 {"bound_source", stress_case.bound_source},
                 {"failure", stress_case.failure},
                 {"arm", result.arm.name()},
                 {"axes", axes_json(result.arm)},
                 {"table", table_of(result.arm, of_case)},
                 {"status", word(result.verdict)},
                 {"parameter", parameter_json(stress_case.parameter)}};
    json.update(numbers_json(result));
    json["reason"] = codec::or_null(result.reason);
    json["curve"] = Json::array();
    if (stress_case.parameter) {
        for (const StressPoint& point : result.curve) json["curve"].push_back(point_json(point));
    }
    return json;
}

Json results_json(const std::vector<StressResult>& results) {
    Json cases = Json::array();
    for (auto begin = results.begin(); begin != results.end();) {
        const auto end = std::find_if(begin, results.end(), [&](const StressResult& r) { return r.of != begin->of; });
        const std::vector<StressResult> of_case(begin, end);
        for (const StressResult& result : of_case) cases.push_back(result_json(result, of_case));
        begin = end;
    }
    return cases;
}

Json summary_json(const std::vector<StressResult>& results) {
    std::set<const StressCase*> cases;
    for (const StressResult& result : results) cases.insert(result.of);
    Json summary = {{"cases", cases.size()}, {"arms", results.size()}};
    for (const StressVerdict verdict :
         {StressVerdict::pass, StressVerdict::limit, StressVerdict::fail, StressVerdict::skipped}) {
        summary[std::string(word(verdict))] = std::ranges::count(results, verdict, &StressResult::verdict);
    }
    return summary;
}

}  // namespace

std::string table_of(const StressArm& arm, const std::vector<StressResult>& results) {
    constexpr std::string_view kShared[] = {kPathAxis, kLayoutAxis, kHdrAxis, kGuardsAxis, kSumsAxis};
    const bool own_axes = std::ranges::any_of(arm.choices(), [&](const auto& choice) {
        return std::ranges::find(kShared, choice.first) == std::end(kShared);
    });
    if (own_axes || arm.get(kPathAxis).empty()) return "others";
    const bool several_paths = values_tried(results, arm, kPathAxis, kLayoutAxis) > 1;
    const bool several_layouts = values_tried(results, arm, kLayoutAxis, kPathAxis) > 1;
    return several_layouts && !several_paths ? "layouts" : "paths";
}

Json ulp_json(const std::vector<UlpRow>& rows) {
    Json list = Json::array();
    for (const UlpRow& row : rows) {
        list.push_back({{"function", row.function},
                        {"domain", row.domain},
                        {"inputs", row.inputs},
                        {"max_ulp", encode(row.max_ulp)},
                        {"mean_ulp", encode(row.mean_ulp)},
                        {"worst_input", codec::or_null(row.worst_input)},
                        {"non_finite", row.non_finite},
                        {"non_finite_input", codec::or_null(row.non_finite_input)}});
    }
    return list;
}

Json stress_json(const StressRun& run) {
    Json json = {{"schema", kStressSchema},
                 {"run",
                  {{"arguments", run.arguments},
                   {"version", run.version},
                   {"git_commit", encode(run.git_commit)},
                   {"quick", run.quick}}},
                 {"environment", to_json(run.environment)},
                 {"rounding", to_json(run.rounding)},
                 {"cases", results_json(run.results)}};
    if (run.ulp) json["ulp"] = ulp_json(*run.ulp);
    json["summary"] = summary_json(run.results);
    return json;
}

}  // namespace lightsweep
