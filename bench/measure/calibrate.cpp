#include "bench/measure/calibrate.h"

#include "bench/measure/environment.h"
#include "bench/measure/scene_store.h"
#include "bench/stats/quantile.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/hash.h"
#include "renderer/gl/context.h"
#include "renderer/paths/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

namespace lightsweep {
namespace {

// What is measured: scenes that differ in triangles, textures and shading models, at sizes and light counts that spread
// every term of the model. Slow paths drop out where their frames grow long: the terms are linear.
struct View {
    const char* scene;
    int width, height;
};
constexpr View kViews[] = {
    {"cornell", 320, 180}, {"cornell", 640, 360}, {"materials", 640, 360}, {"overdraw", 320, 180},
    {"spheres", 640, 360}, {"atrium", 320, 180},  {"atrium", 640, 360},    {"atrium", 1280, 720},
};
constexpr int kLightCounts[] = {1, 16, 128, 1024, 8192};
constexpr double kOverlap = 16.0;
constexpr double kLongestFrameNs = 0.15e9;
constexpr int kFrames = 3;
constexpr const char* kLayout = "oct32";  // the other layouts differ by less than what the model is asked for

// Another machine, driver or build of the program has another model.
std::filesystem::path model_file(const std::string& fingerprint) {
    const auto folder = cache_folder();
    const std::string what = fingerprint + program_version() + program_git_commit().value_or("");
    return folder.empty() ? folder : folder / fmt::format("cost-model-{}.json", hash_hex(what));
}

LightSearch light_search(const Path& path) {
    for (const auto& pass : path.passes) {
        if (pass.shades == Shades::listed_lights_of_covered) return LightSearch::listed;
        if (pass.shades == Shades::one_light) return LightSearch::each;
    }
    return LightSearch::all;
}

// The median of a few frames, after one that warms up.
double frame_ns(Arm& arm) {
    arm.draw();
    std::vector<double> ns;
    for (int i = 0; i < kFrames; ++i) {
        const int64_t start = now_ns();
        arm.draw();
        ns.push_back(static_cast<double>(now_ns() - start));
    }
    return median(ns);
}

// Fragments that pass the depth test in the order of drawing, and those that stay.
void count_fragments(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes, CostFeatures& features) {
    const PathSetup setup{.needs = subject.scene.needs(), .layout = {}};
    Path path;
    path.depth = path.add({.name = "depth", .format = setup.layout.depth});
    path.hdr = path.display = path.depth;
    path.passes = {depth_prepass(setup, path.depth)};
    path.passes[0].shades = Shades::one_light;  // counts samples
    features.fragments = static_cast<double>(Arm(path, setup, subject, buffers, shapes).count_light_evaluations());
    Pass visible = path.passes[0];
    visible.state = equal_state();
    visible.writes = {{path.depth, Load::keep}};
    path.passes[0].shades = Shades::nothing;
    path.passes.push_back(visible);
    features.covered_pixels = static_cast<double>(Arm(path, setup, subject, buffers, shapes).count_light_evaluations());
}

}  // namespace

CostFeatures cost_features(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes) {
    const SceneNeeds& needs = subject.scene.needs();
    const FrameSetup setup{
        .camera = subject.scene.scene().camera, .width = subject.width, .height = subject.height, .convention = {}};
    Frame frame;
    build_frame(subject.scene, subject.lights, setup, frame);
    std::vector<shared::LightBounds> bounds;
    light_bounds(frame, 0.0, bounds);
    const auto grid = make_light_grid(kClusters, setup, bounds);
    LightLists lists;
    build_light_lists(grid, bounds, {}, frame.data.directional_count, lists);
    CostFeatures features{
        .draws = static_cast<double>(frame.work.draws),
        .triangles = static_cast<double>(frame.work.triangles),
        .pixels = static_cast<double>(subject.width) * subject.height,
        .texture_kinds = static_cast<double>(needs.base_color_textures + needs.metallic_roughness_textures +
                                             needs.normal_textures + needs.emissive_textures),
        .models = needs.models,
        .lights = static_cast<double>(bounds.size()),
        .listed_lights = static_cast<double>(lists.indices.size()) / static_cast<double>(cell_count(grid)),
        .cells = static_cast<double>(cell_count(grid)),
    };
    for (const auto& light : bounds) {
        const PixelRect rect = screen_rect(light, setup);
        if (!rect.empty()) {
            features.light_rectangles_px +=
                static_cast<double>(rect.x1 - rect.x0) * static_cast<double>(rect.y1 - rect.y0);
        }
    }
    count_fragments(subject, buffers, shapes, features);
    return features;
}

CostModel calibrate_costs(const Environment& environment, ListBuilder light_lists,
                          const std::function<void(double)>& progress) {
    SceneStore scenes;
    FrameBuffers buffers;
    const DrawShapes shapes;
    std::map<std::string, LightSearch> searches;
    std::map<std::string, std::vector<CostSample>> samples;
    size_t done = 0;
    for (const View& view : kViews) {
        // The arms see the subject's lights change under them: compiled once for all counts.
        Subject subject{scenes.gpu_scene(view.scene), {}, view.width, view.height};
        std::map<std::string, std::unique_ptr<Arm>> arms;
        for (const PathInfo* info : all_paths()) {
            CellParams cell;
            cell.scene = view.scene;
            cell.path = info->key;
            if (info->uses_layout) cell.layout = kLayout;
            if (info->uses_light_lists) cell.light_lists = list_builder_names()[static_cast<size_t>(light_lists)];
            try {
                auto arm = std::make_unique<Arm>(cell, subject, buffers, shapes);
                searches[cell.path] = light_search(info->build(arm->setup()));
                arms[cell.path] = std::move(arm);
            } catch (const EnvironmentError&) {  // the device refuses the path: without samples it is never chosen
            }
        }
        for (const int count : kLightCounts) {
            subject.lights = make_lights(subject.scene.scene(), count, {kOverlap});
            const CostFeatures features = cost_features(subject, buffers, shapes);
            for (auto arm = arms.begin(); arm != arms.end();) {
                bool go_on = false;
                try {
                    const double ns = frame_ns(*arm->second);
                    samples[arm->first].push_back({features, ns});
                    go_on = ns <= kLongestFrameNs;
                } catch (const EnvironmentError&) {  // so many lights are over a limit
                }
                arm = go_on ? std::next(arm) : arms.erase(arm);
            }
            progress(static_cast<double>(++done) / static_cast<double>(std::size(kViews) * std::size(kLightCounts)));
        }
    }
    CostModel model{.fingerprint = environment.fingerprint, .paths = {}};
    for (const auto& key : path_keys()) {
        model.paths[key] = samples.contains(key) ? fit_path_cost(searches.at(key), samples.at(key)) : PathCost{};
    }
    return model;
}

std::optional<CostModel> find_cost_model(const Environment& environment) {
    const auto file = model_file(environment.fingerprint);
    std::error_code missing;
    if (file.empty() || !std::filesystem::exists(file, missing)) return std::nullopt;
    try {
        auto model = parse_cost_model(read_file(file));
        // Another version of the program may have other paths.
        const auto keys = path_keys();
        const bool complete =
            model && std::ranges::all_of(keys, [&](const auto& k) { return model->paths.contains(k); });
        return complete && model->paths.size() == keys.size() ? model : std::nullopt;
    } catch (const InputError&) {  // cannot be read: as good as missing
        return std::nullopt;
    }
}

void keep_cost_model(const CostModel& model) {
    const auto file = model_file(model.fingerprint);
    if (file.empty()) return;
    try {
        std::filesystem::create_directories(file.parent_path());
        write_file_atomically(file, report_text(to_json(model)) + "\n");
    } catch (const std::exception&) {  // no space, no right to write: the next run measures again
    }
}

}  // namespace lightsweep
