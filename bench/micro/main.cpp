// lightsweep_benchmark: the cells of a sweep and the stages of the CPU under Google Benchmark's flags, filters and
// files. Every failure that a user can cure is one line on stderr and an exit code, as of lightsweep itself.
#include "bench/measure/checked_main.h"
#include "bench/measure/environment.h"
#include "bench/measure/frame_timer.h"
#include "bench/micro/cells.h"
#include "bench/micro/stages.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/gl/context.h"
#include "renderer/gl/state.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace lightsweep {
namespace {

constexpr int kRepetitions = 9;  // what compare.py's rank test asks for

struct Options {
    std::string sweep = "smoke";
    std::vector<std::string> axes;
    std::string device = "auto", timer;
    bool allow_debug = false;
    // Google Benchmark's own, read here because they decide what is made before it runs.
    std::string filter, out;
    bool list = false;
    int repetitions = 0;
    std::vector<std::string> rest;  ///< for Google Benchmark
};

void add_options(CLI::App& app, Options& options) {
    app.allow_extras();
    app.add_option("--sweep", options.sweep, "key or .json file of a sweep")->capture_default_str();
    app.add_option("-a,--axis", options.axes, "axis=values, in place of the sweep's (lightsweep run --help)")
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--device", options.device, "auto, egl:N, surfaceless or osmesa (lightsweep list devices)");
    app.add_option("--timer", options.timer, "use this timer and leave the self-test out")
        ->check(CLI::IsMember(timer_methods()));
    app.add_flag("--allow-debug", options.allow_debug, "measure with a Debug build all the same");
    app.add_option("--benchmark_filter", options.filter, "run what matches this regular expression; -REGEX: the others")
        ->envname("BENCHMARK_FILTER");
    app.add_flag("--benchmark_list_tests", options.list, "print the names and stop")->envname("BENCHMARK_LIST_TESTS");
    app.add_option("--benchmark_out", options.out, "file to write")->envname("BENCHMARK_OUT");
    app.add_option("--benchmark_repetitions", options.repetitions,
                   fmt::format("of each benchmark (default: {} of a cell, 1 of a stage)", kRepetitions))
        ->check(CLI::Range(1, 1'000'000))
        ->envname("BENCHMARK_REPETITIONS");
    app.footer("All other flags of Google Benchmark are handed to it:");
}

// Hands flags to the library. `program` must live as long as it runs.
void initialize_library(char* program, std::vector<std::string> flags) {
    std::vector<char*> argv{program};
    for (auto& flag : flags) argv.push_back(flag.data());
    int argc = static_cast<int>(argv.size());
    argv.push_back(nullptr);
    // The library prints its help, and exits with 0, when it does not know a flag's value.
    benchmark::Initialize(&argc, argv.data(), [] {
        throw InputError("a --benchmark_ flag has a value that Google Benchmark does not know (--help shows them)");
    });
    if (argc > 1) throw InputError(fmt::format("unknown argument '{}' (--help shows the usage)", argv[1]));
}

// What the filter selects, in the library's own words. Throws InputError when that is nothing.
std::vector<std::string> selected_names(char* program, const std::string& filter) {
    initialize_library(program, {"--benchmark_list_tests=true", "--benchmark_out=", "--benchmark_filter=" + filter});
    std::ostringstream names, errors;
    benchmark::ConsoleReporter reporter;
    reporter.SetOutputStream(&names);
    reporter.SetErrorStream(&errors);
    benchmark::RunSpecifiedBenchmarks(&reporter);
    std::string text = names.str(), error = errors.str();
    if (text.empty()) throw InputError("--benchmark_filter", error.substr(0, error.find('\n')));
    text.pop_back();  // the last line's end
    return split(text, '\n');
}

// The reporter that the flags ask for; and counts errors, which the library does not tell in its exit code.
class CountingReporter : public benchmark::BenchmarkReporter {
  public:
    explicit CountingReporter(benchmark::BenchmarkReporter& reporter) : reporter_(&reporter) {}
    bool ReportContext(const Context& context) override { return reporter_->ReportContext(context); }
    void ReportRuns(const std::vector<Run>& runs) override {
        failures_ += std::ranges::count_if(runs, [](const Run& run) { return run.error_occurred; });
        reporter_->ReportRuns(runs);
    }
    void Finalize() override { reporter_->Finalize(); }
    int64_t failures() const { return failures_; }

  private:
    benchmark::BenchmarkReporter* reporter_;
    int64_t failures_ = 0;
};

std::unique_ptr<gl::Context> make_context(const std::string& device) {
    auto context = gl::Context::create(device);
    gl::set_context_defaults();
    benchmark::AddCustomContext("gl_renderer", context->info().renderer);
    benchmark::AddCustomContext("gl_version", context->info().version);
    return context;
}

int run(const Options& options, char* program) {
    std::unique_ptr<gl::Context> context;  // must outlive what is made in it
    CellBenchmarks cells(options.sweep, options.axes);
    cells.add(options.repetitions > 0 ? 0 : kRepetitions);
    add_cpu_stages();
    add_reference_stages();
    add_light_list_stages();
    add_culling_stages();
    add_frame_stages();
    const auto selected = selected_names(program, options.filter);
    if (options.list) {
        for (const auto& name : selected) fmt::print("{}\n", name);
        return kDone;
    }
    if (program_build_type() == "Debug" && !options.allow_debug) {
        throw EnvironmentError("this is a Debug build: its times say nothing; build Release (or give --allow-debug)");
    }
    std::vector<std::string> flags{"--benchmark_list_tests=false", "--benchmark_filter=" + options.filter,
                                   "--benchmark_out=" + options.out};
    if (options.repetitions > 0) flags.push_back(fmt::format("--benchmark_repetitions={}", options.repetitions));
    flags.insert(flags.end(), options.rest.begin(), options.rest.end());
    initialize_library(program, flags);

    benchmark::AddCustomContext("lightsweep_version", program_version());
    benchmark::AddCustomContext("lightsweep_git_commit", program_git_commit().value_or("none"));
    benchmark::AddCustomContext("lightsweep_build_type", program_build_type());
    const bool runs_cells = std::ranges::any_of(selected, [&](const auto& name) { return cells.owns(name); });
    if (runs_cells || std::ranges::any_of(selected, is_frame_stage)) context = make_context(options.device);
    if (runs_cells) {
        const std::string method = cells.choose_timer(options.timer);
        benchmark::AddCustomContext("timer", options.timer.empty() ? method : method + " (forced)");
    }
    if (!options.out.empty() && !std::ofstream(options.out, std::ios::app)) {  // the library would exit with 1
        throw InputError(options.out, "cannot be written");
    }
    CountingReporter reporter(*benchmark::CreateDefaultDisplayReporter());
    benchmark::RunSpecifiedBenchmarks(&reporter);
    benchmark::Shutdown();
    return reporter.failures() == 0 ? kDone : kCellsFailed;
}

int run_program(int argc, char** argv) {
    CLI::App app{"The cells of a sweep, and the stages of the CPU, as Google Benchmarks", "lightsweep_benchmark"};
    Options options;
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        const int code = app.exit(help);
        benchmark::PrintDefaultHelp();
        return code;
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{} (--help shows the usage)", error.what()));
    }
    options.rest = app.remaining();
    return run(options, argv[0]);
}

}  // namespace
}  // namespace lightsweep

int main(int argc, char** argv) {
    return lightsweep::checked_main("lightsweep_benchmark", lightsweep::run_program, argc, argv);
}
