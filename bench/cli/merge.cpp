// lightsweep merge: the journals of a sweep's shards, or of an interrupted run, as one report.
#include "bench/report/merge.h"
#include "bench/cli/commands.h"
#include "bench/report/assemble.h"
#include "bench/report/gbench_export.h"
#include "renderer/base/file.h"

#include <fmt/format.h>

#include <memory>

namespace lightsweep {

Command add_merge(CLI::App& app) {
    struct Options {
        std::vector<std::string> journals;
        std::string output, google_benchmark;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("merge", "journals of shards to one report");
    command->add_option("journals", options->journals, "journal.jsonl files")->required();
    command->add_option("-o,--output", options->output, "report.json to write")->required();
    command->add_option("--google-benchmark", options->google_benchmark,
                        "write it in Google Benchmark's JSON form too");
    return [options] {
        std::vector<NamedJournal> journals;
        for (const auto& file : options->journals) journals.push_back({file, read_journal(file)});
        const Json report = assemble_report(merge_journals(journals));
        write_file_atomically(options->output, report_text(report) + "\n");
        fmt::print("report: {}\n", options->output);
        if (!options->google_benchmark.empty()) {
            const Json exported = to_google_benchmark(parse_report(report, options->output));
            write_file_atomically(options->google_benchmark, report_text(exported) + "\n");
            fmt::print("google benchmark: {}\n", options->google_benchmark);
        }
        return kDone;
    };
}

}  // namespace lightsweep
