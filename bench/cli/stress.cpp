// lightsweep stress: the ways in which renderers break, turned up on every path, layout and format until this one does.
#include "bench/cli/commands.h"
#include "bench/cli/device_options.h"
#include "bench/cli/progress.h"
#include "bench/cli/stress_table.h"
#include "bench/measure/environment.h"
#include "bench/measure/frame_timer.h"
#include "bench/stress/cases.h"
#include "bench/stress/fuzz.h"
#include "bench/stress/stress_report.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

namespace lightsweep {
namespace {

namespace fs = std::filesystem;

/// Of a block that the user chose nothing of, so many arms are tried when there is little time.
constexpr size_t kQuickArms = 3;

struct StressOptions {
    DeviceOptions device;
    std::vector<std::string> cases, axes;
    std::string out;
    bool quick = false, json = false;
    FuzzOptions fuzz;
};

struct PlannedCase {
    const StressCase* of = nullptr;
    std::vector<StressArm> arms;
};

std::vector<const StressCase*> chosen_cases(const std::vector<std::string>& ids) {
    const auto all = all_stress_cases();
    if (ids.empty()) return {all.begin(), all.end()};
    std::vector<const StressCase*> chosen;
    for (const auto& id : ids) {
        const StressCase* found = &find_stress_case(id);
        if (std::ranges::find(chosen, found) == chosen.end()) chosen.push_back(found);
    }
    return chosen;
}

// Evenly spread over the block, the first and the last among them.
void keep_a_few(std::vector<StressArm>& arms) {
    if (arms.size() <= kQuickArms) return;
    std::vector<StressArm> few;
    for (size_t i = 0; i < kQuickArms; ++i) few.push_back(arms[i * (arms.size() - 1) / (kQuickArms - 1)]);
    arms = std::move(few);
}

std::vector<StressArm> planned_arms(const StressCase& stress_case, const AxisValues& selection, bool quick) {
    std::vector<StressArm> planned;
    for (const ArmBlock& block : stress_case.arms()) {
        std::vector<StressArm> arms = stress_arms({block}, selection);
        const bool chosen =
            std::ranges::any_of(block, [&](const StressAxis& axis) { return selection.contains(axis.name); });
        if (quick && !chosen) keep_a_few(arms);
        for (StressArm& arm : arms) {
            if (std::ranges::find(planned, arm) == planned.end()) planned.push_back(std::move(arm));
        }
    }
    return planned;
}

// Throws InputError for what a user may have got wrong, before a context is made.
std::vector<PlannedCase> plan_cases(const StressOptions& options) {
    const auto chosen = chosen_cases(options.cases);
    std::vector<ArmBlock> blocks;
    for (const StressCase* stress_case : chosen) {
        for (ArmBlock& block : stress_case->arms()) blocks.push_back(std::move(block));
    }
    const AxisValues selection = parse_stress_axes(options.axes, blocks);
    std::vector<PlannedCase> plan;
    for (const StressCase* stress_case : chosen) {
        PlannedCase planned{.of = stress_case, .arms = planned_arms(*stress_case, selection, options.quick)};
        if (!planned.arms.empty()) plan.push_back(std::move(planned));
    }
    if (plan.empty()) throw InputError("-a " + options.axes.front(), "no case that was chosen has such an arm");
    return plan;
}

// What the driver complains of is a failure of the case that made it do so.
void take_debug_errors(gl::Context& context, StressResult& result) {
    try {
        context.throw_on_debug_errors(result.of->id);
    } catch (const std::exception& error) {
        if (result.verdict == StressVerdict::fail) return;
        result.verdict = StressVerdict::fail;
        result.reason = error.what();
    }
}

std::string case_line(const PlannedCase& planned, const std::vector<StressResult>& results) {
    std::string text = fmt::format("{}: {} arms", planned.of->id, planned.arms.size());
    for (const StressVerdict verdict : {StressVerdict::fail, StressVerdict::limit, StressVerdict::skipped}) {
        const auto count = std::ranges::count_if(
            results, [&](const StressResult& r) { return r.of == planned.of && r.verdict == verdict; });
        if (count > 0) text += fmt::format(", {} {}", count, word(verdict));
    }
    return text;
}

std::vector<StressResult> try_cases(const std::vector<PlannedCase>& plan, gl::Context& context, bool quick) {
    Workbench bench(context.limits());
    std::vector<StressResult> results;
    ProgressBar bar(plan.size(), {}, "case");
    for (size_t i = 0; i < plan.size(); ++i) {
        const auto& [of, arms] = plan[i];
        for (size_t j = 0; j < arms.size(); ++j) {
            bar.update(i, static_cast<double>(j) / static_cast<double>(arms.size()), std::string(of->id));
            results.push_back(judge(*of, arms[j], bench, quick));
            take_debug_errors(context, results.back());
        }
        bar.finish_group(i, case_line(plan[i], results));
    }
    bar.clear();
    return results;
}

fs::path output_folder(const StressOptions& options, const std::string& what) {
    if (!options.out.empty()) return options.out;
    std::string stamp = utc_now();  // 2026-01-31T12:00:00Z
    std::erase_if(stamp, [](char c) { return c == '-' || c == ':' || c == 'Z'; });
    return fs::path("out") / (what + "-" + stamp);
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) throw InputError(folder.string(), "cannot be made: " + failure.message());
}

bool all_finite(const std::vector<UlpRow>& functions) {
    return std::ranges::all_of(functions, [](const UlpRow& row) { return row.non_finite == 0; });
}

int run_cases(const StressOptions& options, const std::vector<std::string>& arguments) {
    const int64_t start_ns = now_ns();
    const auto plan = plan_cases(options);
    const auto context = options.device.make_context();
    const fs::path folder = output_folder(options, "stress"), file = folder / "stress.json";
    make_folder(folder);
    StressRun run{.arguments = arguments,
                  .version = program_version(),
                  .git_commit = program_git_commit(),
                  .quick = options.quick,
                  .environment = read_environment(*context),
                  .rounding = probe_rounding(),
                  .results = try_cases(plan, *context, options.quick),
                  .ulp = {}};
    if (options.cases.empty() && options.axes.empty()) run.ulp = measure_ulp(options.quick);
    context->throw_on_debug_errors("stress ulp");
    const Json json = stress_json(run);
    write_file_atomically(file, report_text(json) + "\n");
    fmt::print("{}", options.json ? report_text(json) + "\n" : stress_text(json));
    fmt::print(stderr, "{}: {:.0f} s\n", file.string(), static_cast<double>(now_ns() - start_ns) * 1e-9);
    return json.at("summary").at("fail") == 0 && (!run.ulp || all_finite(*run.ulp)) ? kDone : kVerdictFailed;
}

int run_ulp(const StressOptions& options) {
    if (!options.out.empty()) throw InputError("stress ulp --out", "it writes no file; --json prints for programs");
    const auto context = options.device.make_context();
    const auto functions = measure_ulp(options.quick);
    const Json rows = ulp_json(functions);
    context->throw_on_debug_errors("stress ulp");
    fmt::print("{}", options.json ? report_text(rows) + "\n" : ulp_text(rows));
    return all_finite(functions) ? kDone : kVerdictFailed;
}

int64_t failures(const FuzzReport& report) {
    return std::ranges::count(report.findings, word(StressVerdict::fail), &FuzzFinding::verdict);
}

Json fuzz_json(const FuzzReport& report) {
    Json findings = Json::array();
    for (const FuzzFinding& finding : report.findings) {
        findings.push_back(
            {{"seed", finding.seed},
             {"cell", finding.cell},
             {"verdict", finding.verdict},
             {"reason", finding.reason},
             {"scene_file", finding.scene_file.empty() ? Json(nullptr) : Json(finding.scene_file.string())}});
    }
    return {{"scenes", report.scenes},
            {"cells", report.cells},
            {"findings", std::move(findings)},
            {"limits", report.limits}};
}

std::string fuzz_text(const FuzzReport& report) {
    std::string text;
    for (const FuzzFinding& finding : report.findings) {
        text += fmt::format("seed {}: {}: {}: {}\n", finding.seed, finding.verdict, finding.cell, finding.reason);
        if (!finding.scene_file.empty()) text += fmt::format("  {}\n", finding.scene_file.string());
    }
    for (const auto& [what, cells] : report.limits) text += fmt::format("limit of {}: {} cells\n", what, cells);
    return text + fmt::format("{} scenes, {} cells, {} fail\n", report.scenes, report.cells, failures(report));
}

int run_fuzz(const StressOptions& options) {
    if (options.quick) throw InputError("stress fuzz --quick", "not of fuzz; allowed: --seconds, --only");
    const auto context = options.device.make_context();
    Workbench bench(context->limits());
    FuzzOptions fuzz_options = options.fuzz;
    fuzz_options.out = output_folder(options, "fuzz");
    ProgressBar bar(1, {}, "fuzz");
    const FuzzReport report = fuzz(bench, fuzz_options, [&](const FuzzReport& so_far) {
        bar.update(0, so_far.seconds / fuzz_options.seconds,
                   fmt::format("{} scenes, {} cells, {} fail", so_far.scenes, so_far.cells, failures(so_far)));
    });
    bar.clear();
    context->throw_on_debug_errors("stress fuzz");
    fmt::print("{}", options.json ? report_text(fuzz_json(report)) + "\n" : fuzz_text(report));
    return failures(report) == 0 ? kDone : kVerdictFailed;
}

}  // namespace

Command add_stress(CLI::App& app, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<StressOptions>();
    CLI::App* command = app.add_subcommand("stress", "turn up what breaks renderers, until this one does");
    options->device.add(*command);
    command->add_option("case", options->cases, "S16, ... (lightsweep list stress); all when none is named");
    command
        ->add_option(
            "-a,--axis", options->axes,
            "axis=values, in place of the cases' own: path=* layout=oct32,float16 depth=D16-standard guards=off")
        ->take_all()
        ->allow_extra_args(false);
    command->add_flag("--quick", options->quick,
                      "three points of each parameter, no bisection, a few arms of each kind");
    command->add_option("--out", options->out,
                        "folder for stress.json, and for what fuzz finds (default: out/stress-<time>)");
    command->add_flag("--json", options->json, "for programs");
    CLI::App* ulp = command->add_subcommand("ulp", "shader functions and encodings against double precision, in ulps");
    CLI::App* fuzzing =
        command->add_subcommand("fuzz", "random scenes from a seed; one that fails is shrunk and written out");
    fuzzing->add_option("--seconds", options->fuzz.seconds, "no new scene begins after that")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1e6));
    fuzzing->add_option("--seed", options->fuzz.seed, "of the first scene; the next ones' follow")
        ->capture_default_str();
    fuzzing->add_option("--only", options->fuzz.only_seed, "the scene of this seed alone");
    fuzzing->add_flag("!--no-shrink", options->fuzz.shrink, "write a scene that fails as it is");
    return [options, arguments, ulp, fuzzing] {
        if (!ulp->parsed() && !fuzzing->parsed()) return run_cases(*options, arguments);
        if (!options->cases.empty() || !options->axes.empty()) {
            throw InputError(ulp->parsed() ? "stress ulp" : "stress fuzz", "takes neither cases nor axes");
        }
        return ulp->parsed() ? run_ulp(*options) : run_fuzz(*options);
    };
}

}  // namespace lightsweep
