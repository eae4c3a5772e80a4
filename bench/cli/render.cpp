// lightsweep render: one cell, or one of its buffers, as a picture.
#include "bench/cli/commands.h"
#include "bench/cli/device_options.h"
#include "bench/measure/arm.h"
#include "bench/measure/list_probe.h"
#include "bench/measure/scene_store.h"
#include "bench/plan/axes.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/base/skips.h"
#include "renderer/paths/paths.h"
#include "renderer/paths/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace lightsweep {
namespace {

struct Options {
    DeviceOptions device;
    std::string scene = "atrium", path = "deferred", layout = "oct32", lights = "default", size = "1280x720";
    std::string overlap = "scene", light_lists = "cpu", hdr = "rgba16f", skip = kSkipEverything;
    std::string guards = kGuards.front(), sums = kSums.front(), view = "final", output;
};

CellParams parse_options(const Options& options) {
    CellParams cell;
    const std::pair<const char*, const std::string*> fields[] = {{"scene", &options.scene},
                                                                 {"lights", &options.lights},
                                                                 {"size", &options.size},
                                                                 {"overlap", &options.overlap},
                                                                 {"path", &options.path},
                                                                 {"layout", &options.layout},
                                                                 {"light_lists", &options.light_lists},
                                                                 {"hdr", &options.hdr},
                                                                 {"skip", &options.skip},
                                                                 {"guards", &options.guards},
                                                                 {"sums", &options.sums}};
    for (const auto& [name, value] : fields) set_cell_field(cell, find_cell_field(name), *value);
    const auto& views = view_names();
    if (std::find(views.begin(), views.end(), options.view) == views.end()) {
        throw InputError(unknown_name("view", options.view, views));
    }
    const auto extension = std::filesystem::path(options.output).extension();
    if (extension != ".png" && extension != ".exr") {
        throw InputError(options.output, "the picture's name must end in .png or .exr");
    }
    if (cell.skip == kAutoSkip)
        throw InputError("--skip auto", "a run decides that; a picture needs a set, such as all");
    if (!find_path(cell.path).uses_layout) cell.layout.clear();
    if (!find_path(cell.path).uses_light_lists) cell.light_lists.clear();
    return cell;
}

// A forward path has no G-buffer: its buffers are those of the control, which loses nothing.
std::unique_ptr<Arm> make_arm(const CellParams& cell, const std::string& view, const Subject& subject,
                              FrameBuffers& buffers, const DrawShapes& shapes) {
    if (view == "final") return std::make_unique<Arm>(cell, subject, buffers, shapes);
    const SceneNeeds& needs = subject.scene.needs();
    const Layout layout = drop_unneeded(load_layout(cell.layout.empty() ? "float32" : cell.layout), needs);
    const PathSetup setup{.needs = needs,
                          .layout = layout,
                          .hdr = gl::Format::RGBA32F,
                          .skips = parse_skips(cell.skip).value(),
                          .guards = cell.guards == kGuards.front()};
    return std::make_unique<Arm>(build_view(view, setup), setup, subject, buffers, shapes);
}

}  // namespace

Command add_render(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "any cell, or one of its buffers, to PNG or EXR");
    options->device.add(*command);
    command->add_option("--scene", options->scene, "key, or a .json, .gltf or .glb file")->capture_default_str();
    command->add_option("--path", options->path, "shading path")->capture_default_str();
    command->add_option("--layout", options->layout, "G-buffer layout, key or .json file")->capture_default_str();
    command->add_option("--lights", options->lights, "light count, or default")->capture_default_str();
    command->add_option("--overlap", options->overlap, "scene, fixed, or lights per point")->capture_default_str();
    command->add_option("--size", options->size, "WxH in pixels")->capture_default_str();
    command->add_option("--light-lists", options->light_lists, "who builds them: cpu, compute or auto")
        ->capture_default_str();
    command->add_option("--hdr", options->hdr, "format of the HDR target")->capture_default_str();
    command->add_option("--skip", options->skip, "what to skip: all, none, all-frustum-sort, none+light_lists, ...")
        ->capture_default_str();
    command->add_option("--guards", options->guards, "on, or off: what may divide by zero or overflow does")
        ->capture_default_str();
    command->add_option("--sums", options->sums, "how lights are added up: plain or compensated")
        ->capture_default_str();
    command->add_option("--view", options->view, "final, or a buffer (lightsweep list views)")->capture_default_str();
    command->add_option("-o,--output", options->output, "image.png (display values) or image.exr (linear values)")
        ->required();
    return [options] {
        CellParams cell = parse_options(*options);
        SceneStore scenes;
        const Scene& scene = scenes.scene(cell.scene);
        auto lights = make_lights(scene, cell.lights.value_or(scene.lights.default_count),
                                  {cell.overlap.value_or(scene.lights.default_overlap)});
        const auto context = options->device.make_context();
        if (cell.light_lists == kAutoLightLists) {
            cell.light_lists = list_builder_names()[static_cast<size_t>(probe_light_lists().faster())];
        }
        FrameBuffers buffers;
        const DrawShapes shapes;
        const Subject subject{scenes.gpu_scene(cell.scene), std::move(lights), cell.width, cell.height};
        const auto arm = make_arm(cell, options->view, subject, buffers, shapes);
        arm->draw();
        context->throw_on_debug_errors("render");
        const bool linear = std::filesystem::path(options->output).extension() == ".exr";
        write_image(linear ? arm->hdr_image() : arm->display_image(), options->output);
        for (const auto& warning : scene.warnings) fmt::print(stderr, "warning: {}\n", warning);
        fmt::print("{}\n", options->output);
        return kDone;
    };
}

}  // namespace lightsweep
