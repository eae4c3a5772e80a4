// lightsweep encodings: what each encoding of each field loses, through the real target format, and what it costs.
#include "bench/cli/commands.h"
#include "bench/cli/device_options.h"
#include "bench/cli/table.h"
#include "bench/encodings/measure.h"
#include "renderer/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <memory>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRounds = 6;
const std::map<std::string, const char*> kUnits = {
    {"deg", "degrees"}, {"rel", "of the value"}, {"abs", "in the value's own range"}};
constexpr const char* kTiming =
    "a whole pass over 1024 x 1024 px (fetch + encode + store, fetch + decode + store) by the clock with glFinish, "
    "median "
    "of rounds interleaved over a field's encodings; depth to encode: drawing a point in each pixel";

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// "encode" -> encode_ns_per_px, encode_low_ns_per_px, encode_high_ns_per_px.
void add_time(Json& json, const std::string& what, const Interval& ns_per_px) {
    json[what + "_ns_per_px"] = ns_per_px.estimate;
    json[what + "_low_ns_per_px"] = ns_per_px.low ? Json(*ns_per_px.low) : Json();
    json[what + "_high_ns_per_px"] = ns_per_px.high ? Json(*ns_per_px.high) : Json();
}

// Two significant digits, never as 1.2e+02.
std::string time_text(const Interval& ns_per_px) {
    return fmt::format("{}", std::stod(fmt::format("{:.1e}", ns_per_px.estimate)));
}

Json to_json(const EncodingResult& r) {
    Json json = {
        {"field", r.field}, {"name", r.name}, {"bits", r.bits}, {"samples", r.error.compared}, {"domain", r.domain}};
    json["mean_" + r.unit] = finite_or_null(r.error.mean);
    json["p99_" + r.unit] = finite_or_null(r.error.p99);
    json["max_" + r.unit] = finite_or_null(r.error.max);
    add_time(json, "encode", r.encode_ns_per_px);
    add_time(json, "decode", r.decode_ns_per_px);
    return json;
}

void print_tables(const std::vector<EncodingResult>& results) {
    for (size_t first = 0; first < results.size();) {
        const std::string& field = results[first].field;
        fmt::print("{}: error {}\n", field, kUnits.at(results[first].unit));
        Table table({"name", "bits", "mean", "p99", "max", "encode ns/px", "decode ns/px", "samples", "values"});
        size_t next = first;
        for (; next < results.size() && results[next].field == field; ++next) {
            const auto& r = results[next];
            table.add({r.name, std::to_string(r.bits), fmt::format("{:.4g}", r.error.mean),
                       fmt::format("{:.4g}", r.error.p99), fmt::format("{:.4g}", r.error.max),
                       time_text(r.encode_ns_per_px), time_text(r.decode_ns_per_px), std::to_string(r.error.compared),
                       r.domain});
        }
        fmt::print("{}\n", table.text());
        first = next;
    }
}

std::vector<Variant> variants_of(const std::string& field) {
    auto variants = shipped_variants();
    if (field.empty()) return variants;
    field_kind(field);  // or throws
    std::erase_if(variants, [&](const Variant& variant) { return variant.field != field; });
    if (variants.empty()) throw InputError("--field", fmt::format("no encoding of '{}' is measured", field));
    return variants;
}

}  // namespace

Command add_encodings(CLI::App& app) {
    struct Options {
        DeviceOptions device;
        std::string field;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("encodings", "error, bits and time of every encoding through the GPU");
    options->device.add(*command);
    command->add_option("--field", options->field, "only this field's (normal, depth, base_color, ...)");
    command->add_flag("--json", options->json, "for programs");
    return [options] {
        const auto variants = variants_of(options->field);
        const auto context = options->device.make_context();
        const auto results = measure_encodings(variants, kRounds);
        context->throw_on_debug_errors("encodings");
        if (!options->json) {
            print_tables(results);
            fmt::print("values are the same for every encoding of a field and domain; on {}\ntime: {}\n",
                       context->info().renderer, kTiming);
            return kDone;
        }
        Json json = {{"gl_renderer", context->info().renderer}, {"timing", kTiming}, {"rounds", kRounds}};
        json["encodings"] = Json::array();
        for (const auto& result : results) json["encodings"].push_back(to_json(result));
        fmt::print("{}\n", json.dump(2));
        return kDone;
    };
}

}  // namespace lightsweep
