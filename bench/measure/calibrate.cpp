#include "bench/measure/calibrate.h"

#include "bench/measure/environment.h"
#include "bench/measure/scene_store.h"
#include "bench/stats/quantile.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/hash.h"
#include "renderer/frame/light_draws.h"
#include "renderer/gl/context.h"
#include "renderer/paths/paths.h"
#include "shaders/shared/light_cell.h"

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
    if (path.light_grid) return path.light_grid->slices ? LightSearch::clusters : LightSearch::tiles;
    const bool each = std::ranges::any_of(path.passes, [](const Pass& p) { return p.shades == Shades::one_light; });
    return each ? LightSearch::each : LightSearch::all;
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

// Draws the depth alone: the view distance of each covered pixel (0 elsewhere), and how many fragments were nearest so
// far when they were drawn.
struct DepthProbe {
    std::vector<float> distances;  // from the bottom row
    double fragments = 0;
};

DepthProbe probe_depth(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes) {
    const PathSetup setup{.needs = subject.scene.needs(), .layout = {}};
    Path path;
    path.depth = path.add({.name = "depth", .format = setup.layout.depth});
    path.hdr = path.display = path.depth;
    path.passes = {depth_prepass(setup, path.depth)};
    path.passes[0].shades = Shades::one_light;  // counts samples
    Arm arm(std::move(path), setup, subject, buffers, shapes);
    DepthProbe probe{.distances = {}, .fragments = static_cast<double>(arm.count_light_evaluations())};
    probe.distances = arm.path().depth().read_floats(1);
    const auto& data = arm.frame().data;
    for (float& depth : probe.distances) {
        depth = depth == data.depth_clear ? 0.0F : view_distance(data, depth);
    }
    return probe;
}

// A frame's lists for a grid, as the surfaces see them.
struct ListedLights {
    double cells = 0;
    double per_covered_pixel = 0;
};

ListedLights list_for(const LightGridDesc& desc, const Frame& frame, std::span<const shared::LightBounds> bounds,
                      const std::vector<float>& distances) {
    const auto width = static_cast<size_t>(frame.setup.width);
    const auto grid = make_light_grid(desc, frame.setup, bounds);
    const auto tile_of = [&](size_t pixel) {
        return pixel / width / grid.tile_px * grid.tiles_x + pixel % width / grid.tile_px;
    };
    std::vector<DepthRange> ranges;
    if (desc.depth_bounds) ranges.assign(size_t{grid.tiles_x} * grid.tiles_y, {1e30F, 0.0F});
    for (size_t i = 0; desc.depth_bounds && i < distances.size(); ++i) {
        if (distances[i] == 0.0F) continue;
        DepthRange& range = ranges[tile_of(i)];
        range = {std::min(range.low, distances[i]), std::max(range.high, distances[i])};
    }
    LightLists lists;
    build_light_lists(grid, bounds, ranges, frame.data.directional_count, lists);
    double listed = 0, covered = 0;
    for (size_t i = 0; i < distances.size(); ++i) {
        if (distances[i] == 0.0F) continue;
        const size_t slice = shared::slice_of(grid, distances[i]);
        listed += lists.cells[slice * grid.tiles_x * grid.tiles_y + tile_of(i)].count;
        ++covered;
    }
    return {.cells = static_cast<double>(cell_count(grid)), .per_covered_pixel = covered > 0 ? listed / covered : 0.0};
}

}  // namespace

CostFeatures cost_features(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes) {
    const SceneNeeds& needs = subject.scene.needs();
    Frame frame;
    build_frame(subject.scene, subject.lights,
                {.camera = subject.scene.scene().camera, .width = subject.width, .height = subject.height}, frame);
    std::vector<shared::LightBounds> bounds;
    light_bounds(frame, 0.0, bounds);
    const DepthProbe depth = probe_depth(subject, buffers, shapes);
    const ListedLights clusters = list_for(kClusters, frame, bounds, depth.distances);
    CostFeatures features{
        .draws = static_cast<double>(frame.work.draws),
        .triangles = static_cast<double>(frame.work.triangles),
        .pixels = static_cast<double>(subject.width) * subject.height,
        .fragments = depth.fragments,
        .covered_pixels = static_cast<double>(depth.distances.size()) -
                          static_cast<double>(std::ranges::count(depth.distances, 0.0F)),
        .texture_kinds = static_cast<double>(needs.base_color_textures + needs.metallic_roughness_textures +
                                             needs.normal_textures + needs.emissive_textures),
        .models = needs.models,
        .lights = static_cast<double>(bounds.size()),
        .cells = clusters.cells,
        .cluster_lights = clusters.per_covered_pixel,
        .tile_lights = list_for(kDepthBoundedTiles, frame, bounds, depth.distances).per_covered_pixel,
    };
    for (const auto& light : bounds) {
        const PixelRect rect = screen_rect(light, frame.setup);
        if (rect.empty()) continue;
        features.light_rectangles_px += static_cast<double>(rect.x1 - rect.x0) * static_cast<double>(rect.y1 - rect.y0);
    }
    for (const LightDraw& light : make_light_draws(subject.scene, frame, frame.visible, bounds).draws) {
        const Batch& batch = subject.scene.batches()[light.draw.batch];
        features.light_triangles += static_cast<double>(light.draw.instance_count) * batch.index_count / 3.0;
    }
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
