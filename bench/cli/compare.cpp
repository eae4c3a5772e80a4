// lightsweep compare: two reports, cell by cell.
#include "bench/report/compare.h"
#include "bench/cli/commands.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

namespace lightsweep {

Command add_compare(CLI::App& app) {
    struct Options {
        std::string base, next;
        std::optional<double> fail_on_percent;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("compare", "two reports: what became faster or slower");
    command->add_option("base", options->base, "report.json")->required();
    command->add_option("new", options->next, "report.json")->required();
    command
        ->add_option("--fail-on", options->fail_on_percent, "exit 1 when a cell is slower by more than this percentage")
        ->check(CLI::Range(0.0, 1e6));
    command->add_flag("--json", options->json, "for programs");
    return [options] {
        const Comparison comparison =
            compare_reports(read_report(options->base), read_report(options->next), options->fail_on_percent);
        if (options->json) {
            fmt::print("{}\n", report_text(to_json(comparison)));
        } else {
            fmt::print("{}", comparison_text(comparison));
        }
        return comparison.failed ? kVerdictFailed : kDone;
    };
}

}  // namespace lightsweep
