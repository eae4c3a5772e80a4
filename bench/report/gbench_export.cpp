#include "bench/report/gbench_export.h"

#include "bench/stats/quantile.h"

namespace lightsweep {
namespace {

Json context(const Report& report) {
    return {{"date", report.run.started_at},
            {"host_name", report.environment.fingerprint},
            {"executable", "lightsweep"},
            {"num_cpus", report.environment.cores},
            {"library_build_type", report.run.build_type == "Debug" ? "debug" : "release"},
            {"lightsweep_version", report.run.version},
            {"cpu", report.environment.cpu},
            {"gl_renderer", report.environment.gl_renderer},
            {"gl_version", report.environment.gl_version}};
}

Json entry(const CellResult& cell, size_t family, size_t repetitions, size_t repetition) {
    return {{"name", cell.name},
            {"family_index", family},
            {"per_family_instance_index", 0},
            {"run_name", cell.name},
            {"run_type", "iteration"},
            {"repetitions", repetitions},
            {"repetition_index", repetition},
            {"threads", 1}};
}

double median_ns(const std::vector<int64_t>& samples_ns) {
    return median(std::vector<double>(samples_ns.begin(), samples_ns.end()));
}

Json medians(const CellResult& cell, size_t family) {
    return {{"name", cell.name + "_median"},
            {"family_index", family},
            {"per_family_instance_index", 0},
            {"run_name", cell.name},
            {"run_type", "aggregate"},
            {"repetitions", cell.samples.count()},
            {"threads", 1},
            {"aggregate_name", "median"},
            {"aggregate_unit", "time"},
            {"iterations", cell.samples.count()},
            {"real_time", median_ns(cell.samples.wall_ns)},
            {"cpu_time", median_ns(cell.samples.cpu_ns)},
            {"time_unit", "ns"},
            {"gpu_ns", median_ns(cell.samples.gpu_ns)}};
}

}  // namespace

Json to_google_benchmark(const Report& report) {
    Json benchmarks = Json::array();
    for (size_t family = 0; family < report.cells.size(); ++family) {
        const CellResult& cell = report.cells[family];
        if (!cell.measured()) {
            Json failed = entry(cell, family, 1, 0);
            failed.update({{"error_occurred", true},
                           {"error_message", cell.reason.value_or("no samples")},
                           {"iterations", 1},
                           {"real_time", 0},
                           {"cpu_time", 0},
                           {"time_unit", "ns"}});
            benchmarks.push_back(std::move(failed));
            continue;
        }
        for (size_t i = 0; i < cell.samples.count(); ++i) {
            Json frame = entry(cell, family, cell.samples.count(), i);
            frame.update({{"iterations", 1},
                          {"real_time", cell.samples.wall_ns[i]},
                          {"cpu_time", cell.samples.cpu_ns[i]},
                          {"time_unit", "ns"},
                          {"gpu_ns", cell.samples.gpu_ns[i]}});
            benchmarks.push_back(std::move(frame));
        }
        benchmarks.push_back(medians(cell, family));
    }
    return {{"context", context(report)}, {"benchmarks", std::move(benchmarks)}};
}

}  // namespace lightsweep
