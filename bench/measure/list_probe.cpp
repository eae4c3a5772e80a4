#include "bench/measure/list_probe.h"

#include "bench/measure/frame_timer.h"
#include "bench/stats/quantile.h"
#include "bench/stats/schedule.h"
#include "renderer/base/error.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/draw.h"
#include "renderer/pass/path.h"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace lightsweep {
namespace {

constexpr int kLights = 1024;
constexpr double kOverlap = 16.0;
constexpr int kWarmUps = 2;
constexpr int kMinRounds = 4;
constexpr int kMaxRounds = 20;
constexpr int64_t kMaxNs = 300'000'000;

// A hall of the atrium's proportions with nothing in it but one triangle: lists know no geometry.
Scene hall() {
    Scene scene;
    scene.key = "light list probe";
    const glm::vec4 tangent(1.0F, 0.0F, 0.0F, 1.0F);
    for (const glm::vec3 corner : {glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 1.0F, 0.0F)}) {
        scene.vertices.push_back({.position = corner, .normal = {0.0F, 0.0F, 1.0F}, .tangent = tangent, .uv = {}});
    }
    scene.indices = {0, 1, 2};
    scene.materials.emplace_back();
    Mesh triangle{.name = "triangle", .first_index = 0, .index_count = 3, .material = 0, .bounds = {}};
    for (const auto& vertex : scene.vertices) triangle.bounds.include(vertex.position);
    scene.meshes.push_back(triangle);
    scene.instances.emplace_back();
    scene.camera = {.eye = {0.0, 2.0, 23.0}, .target = {0.0, 5.0, -10.0}, .far_distance = 80.0};
    LightGenerator generator;
    generator.bounds = {.low = {-9.5, 0.3, -23.5}, .high = {9.5, 13.5, 23.5}};
    generator.radius = 12.0;
    scene.lights.generator = generator;
    return scene;
}

int64_t median_ns(const std::vector<double>& times) { return static_cast<int64_t>(median(times)); }

}  // namespace

std::string ListProbe::why() const {
    const auto ms = [](int64_t ns) { return fmt::format("{:.3g} ms", static_cast<double>(ns) * 1e-6); };
    const std::string lights_text = fmt::format("{},{:03}", lights / 1000, lights % 1000);
    if (!compute_ns) return fmt::format("cpu {} for {} lights; compute: {}", ms(cpu_ns), lights_text, refusal);
    return fmt::format("cpu {}, compute {} for {} lights", ms(cpu_ns), ms(*compute_ns), lights_text);
}

ListProbe probe_light_lists() {
    const Scene scene = hall();
    const GpuScene gpu_scene(scene, scene_needs(scene));
    Frame frame;
    build_frame(gpu_scene, make_lights(scene, kLights, {kOverlap}),
                {.camera = scene.camera, .width = 1280, .height = 720}, frame);
    FrameBuffers buffers;
    buffers.upload(frame);
    buffers.bind(gpu_scene);

    ListProbe probe{.lights = kLights, .cpu_ns = 0, .compute_ns = {}};
    std::vector<LightListService> services;
    const auto add_warm = [&](ListBuilder builder) {
        LightListService service(kClusters, builder, 0.0);
        for (int i = 0; i < kWarmUps; ++i) {
            service.build(frame, nullptr);
            service.grow_if_cut_short();
        }
        services.push_back(std::move(service));
    };
    add_warm(ListBuilder::cpu);
    try {
        add_warm(ListBuilder::compute);
    } catch (const std::exception& error) {  // over a limit, or its shaders do not compile
        probe.refusal = error.what();
    }
    std::array<std::vector<double>, 2> times;
    const int64_t start = now_ns();
    for (size_t round = 0; round < kMaxRounds; ++round) {
        if (round >= kMinRounds && now_ns() - start > kMaxNs) break;
        for (const size_t s : schedule(services.size(), round)) {
            gl::finish();
            const int64_t build_start = now_ns();
            services[s].build(frame, nullptr);
            gl::finish();
            times[s].push_back(static_cast<double>(now_ns() - build_start));
        }
    }
    probe.cpu_ns = median_ns(times[0]);
    if (services.size() > 1) probe.compute_ns = median_ns(times[1]);
    return probe;
}

Json to_json(const ListProbe& probe) {
    return {{"lights", probe.lights},
            {"cpu_ns", probe.cpu_ns},
            {"compute_ns", probe.compute_ns ? Json(*probe.compute_ns) : Json(nullptr)},
            {"faster", list_builder_names()[static_cast<size_t>(probe.faster())]},
            {"why", probe.why()}};
}

}  // namespace lightsweep
