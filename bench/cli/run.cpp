// lightsweep run: measures a sweep, group by group; each finished group is on disk before the next begins.
#include "bench/cli/run.h"
#include "bench/cli/commands.h"
#include "bench/cli/costs.h"
#include "bench/cli/progress.h"
#include "bench/cli/summary.h"
#include "bench/measure/catalog.h"
#include "bench/measure/environment.h"
#include "bench/measure/group_runner.h"
#include "bench/measure/self_test.h"
#include "bench/plan/plan.h"
#include "bench/report/assemble.h"
#include "bench/report/journal.h"
#include "bench/report/time_error.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"
#include "renderer/gbuffer/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>

namespace lightsweep {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> interrupted{false};

extern "C" void on_interrupt(int) { interrupted = true; }

// "90s", "3m", "1h", or a number of seconds; "2%" or a fraction.
double parse_quantity(const std::string& option, const std::string& text,
                      const std::vector<std::pair<std::string, double>>& units, const std::string& allowed) {
    double value = 0.0;
    const auto [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string unit(rest, text.data() + text.size());
    for (const auto& [name, factor] : units) {
        if (failure == std::errc() && unit == name && value > 0.0 && value < 1e9) return value * factor;
    }
    throw InputError(fmt::format("{} {}: {} was expected", option, text, allowed));
}

double parse_duration(const std::string& text) {
    return parse_quantity("--time-budget", text, {{"", 1.0}, {"s", 1.0}, {"m", 60.0}, {"min", 60.0}, {"h", 3600.0}},
                          "a duration such as 90s, 3m or 1h");
}

double parse_frame_limit_s(const std::string& text) {
    return parse_quantity("--max-frame", text, {{"", 1.0}, {"s", 1.0}, {"ms", 1e-3}}, "a time such as 2s or 500ms");
}

double parse_share(const std::string& text) {
    return parse_quantity("--target-ci", text, {{"", 1.0}, {"%", 0.01}}, "a share such as 2% or 0.02");
}

double parse_time_ns(const std::string& text) {
    return parse_quantity("--max-time", text, {{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}},
                          "a time such as 8ms, 500us or 0.02s");
}

// "flip=0.01"
ErrorLimit parse_error_limit(const std::string& text) {
    std::vector<std::string> words = kBoundableMetrics;
    words.insert(words.begin(), "flip");
    const size_t sign = text.find('=');
    const std::string metric = text.substr(0, sign);
    if (std::ranges::find(words, metric) == words.end()) {
        throw InputError("--max-error " + text, unknown_name("metric", metric, words));
    }
    const std::string number = sign == std::string::npos ? "" : text.substr(sign + 1);
    double limit = 0.0;
    const auto [rest, failure] = std::from_chars(number.data(), number.data() + number.size(), limit);
    if (failure != std::errc() || rest != number.data() + number.size() || !std::isfinite(limit) || limit < 0.0) {
        throw InputError("--max-error " + text, "METRIC=VALUE with a number from 0 was expected, such as flip=0.01");
    }
    return {.metric = metric == "flip" ? kErrorMetric : metric, .limit = limit};
}

// Everything a user may have got wrong, found before a context is made or a file is written.
void check_inputs(const Plan& plan, SceneStore& scenes) {
    std::set<std::string> layouts;
    for (const auto& group : plan.groups) {
        const CellParams& first = group.cells.front();
        const Scene& scene = scenes.scene(first.scene);
        if (first.lights) make_lights(scene, std::min(*first.lights, 1 << 12), {});
        for (const auto& cell : group.cells) {
            if (!cell.layout.empty() && layouts.insert(cell.layout).second) load_layout(cell.layout);
        }
    }
}

int print_plan(const Plan& plan) {
    for (const auto& group : plan.groups) {
        fmt::print("{}\n", group.key);
        for (const auto& cell : group.cells) fmt::print("  {}  {}\n", cell.id(), cell.name());
    }
    fmt::print("{} cells in {} groups, plan {}\n", plan.cell_count, plan.groups.size(), plan.hash);
    return kDone;
}

fs::path output_folder(const RunOptions& options, const Sweep& sweep) {
    if (!options.out.empty()) return options.out;
    std::string stamp = utc_now();  // 2026-01-31T12:00:00Z
    std::erase_if(stamp, [](char c) { return c == '-' || c == ':' || c == 'Z'; });
    return fs::path("out") / (fs::path(sweep.key).stem().string() + "-" + stamp);
}

// The sweep's limits, or the user's in their place.
struct Limits {
    std::optional<double> budget_s, max_frame_s;
    double target_ci = 0.02;
};

Limits limits_of(const RunOptions& options, const Sweep& sweep) {
    Limits limits{.budget_s = sweep.time_budget_s, .max_frame_s = sweep.max_frame_s};
    limits.target_ci = options.target_ci.empty() ? sweep.target_ci.value_or(0.02) : parse_share(options.target_ci);
    if (!options.time_budget.empty()) limits.budget_s = parse_duration(options.time_budget);
    if (!options.max_frame.empty()) limits.max_frame_s = parse_frame_limit_s(options.max_frame);
    return limits;
}

RunInfo make_run_info(const Plan& plan, const RunOptions& options, const Limits& limits,
                      const std::vector<std::string>& arguments) {
    RunInfo run;
    run.arguments = arguments;
    run.version = program_version();
    run.git_commit = program_git_commit();
    run.build_type = program_build_type();
    run.seed = options.seed;
    run.plan_hash = plan.hash;
    run.shard = plan.shard;
    run.planned_cells = static_cast<int64_t>(plan.cell_count);
    run.plan_cells = static_cast<int64_t>(plan.total_cell_count);
    run.started_at = utc_now();
    run.time_budget_s = limits.budget_s;
    run.target_ci = limits.target_ci;
    run.max_frame_s = limits.max_frame_s;
    if (!options.max_error.empty()) run.max_error = parse_error_limit(options.max_error);
    if (!options.max_time.empty()) run.max_time_ns = parse_time_ns(options.max_time);
    return run;
}

std::string group_line(const GroupResult& group) {
    const auto ok =
        std::count_if(group.cells.begin(), group.cells.end(), [](const auto& c) { return c.status == CellStatus::ok; });
    const size_t rounds = group.noise ? group.noise->round.size() : 0;
    return fmt::format("{}: {} of {} cells ok, {} rounds, {:.1f} s", group.group, ok, group.cells.size(), rounds,
                       group.wall_s);
}

// What this command asks replaces what the journal's first one asked: answers are worked out from samples.
JournalContent read_with_questions(const fs::path& journal_file, const RunInfo& asked) {
    JournalContent journal = read_journal(journal_file);
    if (asked.max_error) journal.run.max_error = asked.max_error;
    if (asked.max_time_ns) journal.run.max_time_ns = asked.max_time_ns;
    return journal;
}

bool asks_for_auto_path(const Plan& plan, const std::set<std::string>& done) {
    return std::ranges::any_of(plan.groups, [&](const PlanGroup& group) {
        return !done.contains(group.key) &&
               std::ranges::any_of(group.cells, [](const CellParams& cell) { return cell.path == kAutoPath; });
    });
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) throw InputError(folder.string(), "cannot be made: " + failure.message());
}

// What a group needs of the budget next to others: some of each cell's work is the same for every size, the rest goes
// by pixels.
double budget_weight(const PlanGroup& group) {
    constexpr double kFixedWorkPx = 3e5;
    const CellParams& first = group.cells.front();
    return static_cast<double>(group.cells.size()) * (kFixedWorkPx + 1.0 * first.width * first.height);
}

// Runs what the journal does not hold yet. Time that a fast group leaves goes to those after it.
void run_groups(const Plan& plan, const std::set<std::string>& done, GroupRunner& runner, JournalWriter& journal,
                std::optional<double> budget_s, const SamplingRules& all_groups, int64_t start_ns) {
    const auto seconds = [&] { return static_cast<double>(now_ns() - start_ns) * 1e-9; };
    ProgressBar bar(plan.groups.size(), budget_s);
    double weight_left = 0.0;
    for (const auto& group : plan.groups) weight_left += done.contains(group.key) ? 0.0 : budget_weight(group);
    double last = 0.0;
    for (size_t i = 0; i < plan.groups.size() && !interrupted; ++i) {
        const PlanGroup& group = plan.groups[i];
        if (done.contains(group.key)) continue;
        SamplingRules rules = all_groups;
        const double weight = budget_weight(group);
        if (budget_s) rules.seconds = std::max(0.0, *budget_s - seconds()) * weight / weight_left;
        weight_left -= weight;
        GroupResult result = runner.run(group, rules, [&](double fraction) { bar.update(i, fraction, group.key); });
        if (interrupted) break;
        result.wall_s = seconds() - last;
        last = seconds();
        journal.append(result);
        bar.finish_group(i, group_line(result));
    }
    bar.clear();
}

}  // namespace

void check_run_options(const RunOptions& options) {
    if (program_build_type() == "Debug" && !options.allow_debug && !options.dry_run) {
        throw EnvironmentError("this is a Debug build: its times say nothing; build Release (or give --allow-debug)");
    }
    if (!options.time_budget.empty()) parse_duration(options.time_budget);
    if (!options.target_ci.empty()) parse_share(options.target_ci);
    if (!options.max_frame.empty()) parse_frame_limit_s(options.max_frame);
    if (!options.max_error.empty()) parse_error_limit(options.max_error);
    if (!options.max_time.empty()) parse_time_ns(options.max_time);
    if (!options.timer.empty() &&
        std::find(timer_methods().begin(), timer_methods().end(), options.timer) == timer_methods().end()) {
        throw InputError(unknown_name("timer", options.timer, timer_methods()));
    }
}

int run_sweep(const RunOptions& options, const std::vector<std::string>& arguments) {
    const int64_t start_ns = now_ns();
    check_run_options(options);
    const Catalog names = program_catalog();
    const Sweep sweep = load_sweep(options.sweep, names);
    const Plan plan =
        make_plan(sweep, parse_axis_arguments(options.axes, names), options.filter, parse_shard(options.shard), names);
    const Limits limits = limits_of(options, sweep);
    const RunInfo info = make_run_info(plan, options, limits, arguments);
    SceneStore scenes(options.seed);
    check_inputs(plan, scenes);
    if (options.dry_run) return print_plan(plan);

    const fs::path folder = output_folder(options, sweep);
    const fs::path journal_file = folder / "journal.jsonl", report_file = folder / "report.json";
    const auto context = options.device.make_context();
    const Environment environment = read_environment(*context);
    const bool resuming = options.resume && fs::exists(journal_file);
    std::set<std::string> done;
    JournalContent begun;
    TimerReport timer;
    if (resuming) {
        begun = read_journal(journal_file);
        done = finished_groups(begun, journal_file, info, environment);
        timer = begun.timer;  // one journal, one timer: what goes on is timed as what was begun
        if (!options.timer.empty() && options.timer != timer.method) {
            throw InputError("--timer " + options.timer,
                             fmt::format("cannot be resumed: {} was timed by {}", journal_file.string(), timer.method));
        }
    } else if (fs::exists(journal_file)) {
        throw InputError(
            journal_file.string(),
            "exists already and may hold results; --resume goes on with it, or write elsewhere with --out");
    } else {
        timer = options.timer.empty() ? choose_timer(test_timers(all_timers())) : choose_timer({}, options.timer);
    }

    std::optional<CostModel> costs;
    if (asks_for_auto_path(plan, done)) costs = known_costs(environment);

    SamplingRules rules{.target_ci = limits.target_ci};
    if (limits.max_frame_s) rules.max_frame_s = *limits.max_frame_s;
    if (options.maps || sweep.maps) rules.maps_folder = folder / "maps";
    make_folder(rules.maps_folder.empty() ? folder : rules.maps_folder);
    JournalWriter journal =
        resuming ? JournalWriter::resume(journal_file) : JournalWriter::create(journal_file, info, environment, timer);
    fmt::print(stderr, "{}: {} cells in {} groups on {}; timer {}\n", sweep.key, plan.cell_count, plan.groups.size(),
               environment.gl_renderer, timer.method);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    GroupRunner runner(scenes, timer.method, interrupted);
    if (costs) runner.know_costs(std::move(*costs));
    for (const auto& group : begun.groups) runner.remember(group);
    run_groups(plan, done, runner, journal, limits.budget_s, rules, start_ns);

    const Json report = assemble_report(read_with_questions(journal_file, info));
    write_file_atomically(report_file, report_text(report) + "\n");
    fmt::print("{}\nreport: {}\n{}", summary_text(report), report_file.string(), answers_text(report));
    if (interrupted) {
        fmt::print(stderr,
                   "interrupted; `lightsweep run {} --resume --out {}` goes on, with --axis, --filter, --shard and "
                   "--seed as they were\n",
                   options.sweep, folder.string());
        return kInterrupted;
    }
    // That a frame may not take longer was asked for.
    const auto& cells = report.at("cells");
    const bool any_failed = std::any_of(cells.begin(), cells.end(), [](const Json& cell) {
        return cell.at("status") != "ok" && cell.at("too_slow_at_lights").is_null();
    });
    return any_failed ? kCellsFailed : kDone;
}

Command add_run(CLI::App& app, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "measure a sweep");
    options->device.add(*command);
    command->add_option("sweep", options->sweep, "key or .json file of a sweep")->capture_default_str();
    command
        ->add_option("-a,--axis", options->axes,
                     "axis=values, in place of the sweep's: lights=1,16,256 lights=pow2:0:12 "
                     "size=640x360,1280x720 path=* scene=atrium,model.gltf skip=all,none,all-*")
        ->take_all();
    command->add_option("--out", options->out,
                        "folder for journal.jsonl and report.json (default: out/<sweep>-<time>)");
    command->add_option("--time-budget", options->time_budget, "for the whole run: 90s, 3m, 1h");
    command->add_option("--target-ci", options->target_ci,
                        "stop a group when its medians are known to this half width: 2%");
    command->add_option("--max-frame", options->max_frame,
                        "an arm whose frame takes longer is drawn once and not sampled, nor drawn with more lights: "
                        "2s, 500ms");
    command->add_option("--max-error", options->max_error,
                        "ask for the cheapest arm within this error against the reference: flip=0.01 (or rmse, mrse, "
                        "max_abs, of display values)");
    command->add_option("--max-time", options->max_time,
                        "ask for the most exact arm within this time: 8ms, 500us, 0.02s");
    command->add_flag("--maps", options->maps, "write each cell's FLIP map to maps/<cell id>.png in the output folder");
    command->add_option("--filter", options->filter, "only cells whose name matches this regular expression");
    command->add_option("--shard", options->shard, "i/n: only this part of the groups")->capture_default_str();
    command->add_flag("--resume", options->resume, "go on with the journal in --out");
    command->add_option("--seed", options->seed, "of the generated lights; 0: as the scenes say")
        ->check(CLI::Range(int64_t{0}, std::numeric_limits<int64_t>::max()));
    command->add_option("--timer", options->timer, "use this timer, without the self-test");
    command->add_flag("--dry-run", options->dry_run, "print the plan and stop");
    command->add_flag("--allow-debug", options->allow_debug, "measure with a Debug build all the same");
    return [options, arguments] { return run_sweep(*options, arguments); };
}

}  // namespace lightsweep
