// lightsweep explore: proposes G-buffer layouts for a scene, and times those that nothing beats in bytes and error.
#include "bench/explore/explore.h"
#include "bench/cli/commands.h"
#include "bench/cli/progress.h"
#include "bench/cli/run.h"
#include "bench/cli/table.h"
#include "bench/measure/scene_store.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/resources.h"
#include "renderer/gbuffer/layout_json.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace lightsweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ExploreOptions {
    RunOptions run;
    std::string scene = "atrium", lights = "default", size = "640x360", options;
    int max_bytes = 16;
};

CellParams view_of(const ExploreOptions& options) {
    CellParams cell;
    set_cell_field(cell, find_cell_field("scene"), options.scene);
    set_cell_field(cell, find_cell_field("lights"), options.lights);
    set_cell_field(cell, find_cell_field("size"), options.size);
    return cell;
}

Exploration explore_view(const ExploreOptions& options, const CellParams& view) {
    const Options candidates =
        load_options(options.options.empty() ? resource("bench/explore/options.json").string() : options.options);
    SceneStore scenes(options.run.seed);
    const Scene& scene = scenes.scene(view.scene);
    auto lights = make_lights(scene, view.lights.value_or(scene.lights.default_count), {scene.lights.default_overlap});
    const auto context = options.run.device.make_context();
    FrameBuffers buffers;
    const DrawShapes shapes;
    const Subject subject{scenes.gpu_scene(view.scene), std::move(lights), view.width, view.height};
    ProgressBar bar(1, {});
    auto result = explore(subject, candidates, options.max_bytes, buffers, shapes,
                          [&](const std::string& what, double fraction) { bar.update(0, fraction, what); });
    bar.clear();
    context->throw_on_debug_errors("explore");
    return result;
}

void print_exploration(const Exploration& found) {
    Table options({"option", "bits", "error alone", ""});
    for (const auto& o : found.options) {
        options.add({o.name, std::to_string(o.bits), fmt::format("{:.2e}", o.rmse), o.kept ? "" : "left out"});
    }
    fmt::print("{}error alone: RMSE of display values against the control, this field packed and no other\n\n",
               options.text());
    Table layouts({"layout", "B/px", "FLIP", "RMSE", "predicted", "", "made of"});
    for (const auto& l : found.layouts) {
        layouts.add({l.layout.key, std::to_string(l.bytes_per_px), fmt::format("{:.2e}", l.flip_mean),
                     fmt::format("{:.2e}", l.rmse), fmt::format("{:.2e}", l.predicted), l.on_front ? "front" : "",
                     l.layout.summary});
    }
    fmt::print("{}B/px: depth included; {} combinations fit, the most promising of each size were drawn\n",
               layouts.text(), found.combinations);
}

// The layouts of the front as files, and a sweep over them beside the control: whatever comes next is an ordinary run.
fs::path write_sweep(const ExploreOptions& options, const CellParams& view, const Exploration& found) {
    const fs::path folder = options.run.out;
    std::error_code failure;
    fs::create_directories(folder / "layouts", failure);
    if (failure) throw InputError(folder.string(), "cannot be made: " + failure.message());
    Json layouts = Json::array({"float32"});
    for (const auto& explored : found.layouts) {
        if (!explored.on_front) continue;
        const fs::path file = folder / "layouts" / (explored.layout.key + ".json");
        write_file_atomically(file, layout_json(explored.layout));
        layouts.push_back(file.string());
    }
    Json block = {
        {"scene", view.scene}, {"size", options.size}, {"path", "deferred"}, {"layout", layouts}, {"hdr", "rgba32f"}};
    if (view.lights) block["lights"] = *view.lights;
    const Json sweep = {{"summary", fmt::format("Explored layouts of at most {} bytes per pixel.", options.max_bytes)},
                        {"time_budget_s", 30},
                        {"blocks", Json::array({block})}};
    const fs::path file = folder / "sweep.json";
    write_file_atomically(file, sweep.dump(2) + "\n");
    return file;
}

int explore_and_run(ExploreOptions options, const std::vector<std::string>& arguments) {
    check_run_options(options.run);
    const CellParams view = view_of(options);
    if (options.run.out.empty()) options.run.out = "out/explore-" + fs::path(view.scene).stem().string();
    if (fs::exists(fs::path(options.run.out) / "journal.jsonl")) {
        throw InputError(options.run.out, "holds a run already; write elsewhere with --out");
    }
    const Exploration found = explore_view(options, view);
    print_exploration(found);
    options.run.sweep = write_sweep(options, view, found).string();
    fmt::print("layouts and sweep: {}\n\n", options.run.out);
    std::fflush(stdout);  // before the run's own lines on stderr
    return run_sweep(options.run, arguments);
}

}  // namespace

Command add_explore(CLI::App& app, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<ExploreOptions>();
    CLI::App* command = app.add_subcommand("explore", "propose G-buffer layouts for a scene, and time the best");
    options->run.device.add(*command);
    command->add_option("--scene", options->scene, "key, or .json, .gltf or .glb file")->capture_default_str();
    command->add_option("--max-bytes", options->max_bytes, "per pixel of the G-buffer, depth included")
        ->capture_default_str()
        ->check(CLI::Range(1, 256));
    command->add_option("--lights", options->lights, "light count, or default")->capture_default_str();
    command->add_option("--size", options->size, "WxH in pixels")->capture_default_str();
    command->add_option("--options", options->options, "file of encodings to combine (default: the shipped ones)");
    command->add_option("--out", options->run.out, "folder for the layouts, the sweep and its report");
    command->add_option("--time-budget", options->run.time_budget, "for timing: 30s, 1m");
    command->add_option("--max-error", options->run.max_error, "ask for the cheapest arm within: flip=0.01");
    command->add_option("--max-time", options->run.max_time, "ask for the most exact arm within: 8ms");
    command->add_flag("--allow-debug", options->run.allow_debug, "measure with a Debug build all the same");
    command->add_option("--timer", options->run.timer, "use this timer, without the self-test");
    command->add_flag("--maps", options->run.maps, "write each layout's FLIP map");
    return [options, arguments] { return explore_and_run(*options, arguments); };
}

}  // namespace lightsweep
