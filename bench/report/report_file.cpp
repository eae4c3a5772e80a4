#include "bench/report/report_file.h"

#include "bench/report/json_codec.h"
#include "bench/report/sound.h"

#include "renderer/base/file.h"
#include "renderer/base/json_reader.h"

#include <fmt/format.h>

namespace lightsweep {

Report parse_report(const Json& json, const std::string& where) {
    if (!json.is_object() || !json.contains("schema")) {
        throw InputError(where,
                         fmt::format("not a report of this program: \"schema\": \"{}\" is missing", kReportSchema));
    }
    require_schema(json.at("schema"), where + ":/schema");
    Report report;
    report.run = from_json<RunInfo>(codec::member<Json>(json, "run", where), where + ":/run");
    report.environment =
        from_json<Environment>(codec::member<Json>(json, "environment", where), where + ":/environment");
    report.noise_floor =
        codec::member<std::optional<double>>(codec::member<Json>(json, "noise", where), "floor", where + ":/noise");
    const auto cells = codec::member<std::vector<Json>>(json, "cells", where);
    for (size_t i = 0; i < cells.size(); ++i) {
        const std::string place = fmt::format("{}:/cells/{}", where, i);
        report.cells.push_back(from_json<CellResult>(cells[i], place));
        require_sound(report.cells.back(), place);
    }
    return report;
}

Report read_report(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    check_nesting(text, file.string());
    try {
        return parse_report(Json::parse(text), file.string());
    } catch (const Json::exception& error) {
        throw InputError(file.string(), fmt::format("not JSON: {}", error.what()));
    }
}

}  // namespace lightsweep
