#include "bench/micro/guarded.h"
#include "bench/micro/stages.h"
#include "renderer/base/random.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/draw.h"
#include "renderer/scene/shapes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace lightsweep {
namespace {

constexpr std::string_view kPrefix = "frame/";

// Boxes at random in a cube whose middle the camera stands in, looking along -z: it sees about a tenth of them.
Scene scattered_boxes(int64_t count) {
    constexpr double kHalfExtent = 50.0;
    Scene scene;
    scene.key = "scattered_boxes";
    scene.materials.emplace_back();
    scene.meshes.push_back(append_geometry(scene, make_shape(BoxShape{}), "box", scene.key));
    Random random(1);
    const auto coordinate = [&] { return random.uniform(-kHalfExtent, kHalfExtent); };
    for (int64_t i = 0; i < count; ++i) {
        const double x = coordinate(), y = coordinate(), z = coordinate();
        scene.instances.push_back({.mesh = 0, .transform = glm::translate(glm::dmat4(1.0), {x, y, z})});
    }
    scene.camera = {.eye = glm::dvec3(0.0), .target = {0.0, 0.0, -1.0}};
    scene.lights.generator = LightGenerator{.bounds = {glm::dvec3(-kHalfExtent), glm::dvec3(kHalfExtent)}};
    return scene;
}

// What a frame of `instances` boxes and `lights` lights is built from, uploaded.
struct FrameInput {
    FrameInput(int64_t instances, int light_count)
        : scene(scattered_boxes(instances)),
          gpu_scene(scene, scene_needs(scene)),
          lights(make_lights(scene, light_count, {})),
          setup{.camera = scene.camera, .width = 1280, .height = 720} {}

    Scene scene;
    GpuScene gpu_scene;
    std::vector<Light> lights;
    FrameSetup setup;
};

void build(benchmark::State& state, int64_t instances, int lights) {
    const FrameInput input(instances, lights);
    Frame frame;
    for (auto _ : state) {
        build_frame(input.gpu_scene, input.lights, input.setup, frame);
        benchmark::DoNotOptimize(frame.visible.instances.data());
        benchmark::DoNotOptimize(frame.lights.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * (instances + lights));
    state.counters["visible"] = static_cast<double>(frame.visible.instances.size() + frame.lights.size());
}

void upload(benchmark::State& state, int64_t instances, int lights) {
    const FrameInput input(instances, lights);
    Frame frame;
    build_frame(input.gpu_scene, input.lights, input.setup, frame);
    FrameBuffers buffers;
    for (auto _ : state) {
        buffers.upload(frame);
        gl::finish();
    }
    const size_t bytes = sizeof frame.data + frame.visible.instances.size() * sizeof(uint32_t) +
                         frame.lights.size() * sizeof(shared::LightData);
    state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(bytes));
}

}  // namespace

void add_frame_stages() {
    const auto add = [](const std::string& stage, auto body, int64_t instances, int lights) {
        const std::string name = std::string(kPrefix) + stage + "/instances:" + std::to_string(instances) +
                                 "/lights:" + std::to_string(lights);
        add_benchmark(name, [=](benchmark::State& state) { body(state, instances, lights); })
            ->Unit(benchmark::kMicrosecond)
            ->UseRealTime();
    };
    for (const int64_t instances : {1'000, 10'000, 100'000}) add("build", build, instances, 64);
    for (const int lights : {1 << 10, 1 << 16}) add("build", build, 1, lights);
    add("upload", upload, 100'000, 64);
    add("upload", upload, 1, 1 << 16);
}

bool is_frame_stage(std::string_view name) { return name.starts_with(kPrefix); }

}  // namespace lightsweep
