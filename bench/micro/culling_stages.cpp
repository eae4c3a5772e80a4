// What the CPU leaves out of a frame, stage by stage, on one core: boxes at random in a cube, seen at 1280x720 from its
// middle (a tenth of them is in view) or from outside (all are). Items are boxes.
#include "bench/micro/guarded.h"
#include "bench/micro/stages.h"
#include "renderer/base/random.h"
#include "renderer/frame/cull.h"
#include "renderer/frame/occlusion.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace lightsweep {
namespace {

constexpr double kHalfExtent = 50.0;
constexpr double kBoxRadius = 0.9;
constexpr size_t kLights = 65'536;

struct Boxes {
    std::vector<Batch> batches{1};
    std::vector<InstanceBounds> bounds;
    SphereArrays spheres;
    Frame frame;
};

Boxes scattered_boxes(int64_t count, double eye_distance) {
    Boxes boxes;
    boxes.batches[0].index_count = 36;
    Random random(1);
    const auto coordinate = [&] { return random.uniform(-kHalfExtent, kHalfExtent); };
    for (uint32_t i = 0; i < count; ++i) {
        const double x = coordinate(), y = coordinate(), z = coordinate();
        boxes.batches[0].instances.push_back(i);
        boxes.bounds.push_back({{x, y, z}, kBoxRadius});
        boxes.spheres.add(boxes.bounds.back());
    }
    boxes.frame.setup = {
        .camera = {.eye = {0.0, 0.0, eye_distance}, .target = glm::dvec3(0.0, 0.0, -1e3), .far_distance = 1e3},
        .width = 1280,
        .height = 720};
    return boxes;
}

void cull(benchmark::State& state, Boxes boxes, bool sorts) {
    if (!sorts) boxes.frame.setup.skips = boxes.frame.setup.skips.without(Skip::sort);
    for (auto _ : state) {
        cull_instances(boxes.batches, boxes.spheres, boxes.frame);
        benchmark::DoNotOptimize(boxes.frame.visible.instances.data());
        benchmark::ClobberMemory();
    }
    state.counters["visible"] = static_cast<double>(boxes.frame.visible.instances.size());
}

void cull_instances_alone(benchmark::State& state, Boxes boxes) { cull(state, std::move(boxes), false); }
void cull_and_sort(benchmark::State& state, Boxes boxes) { cull(state, std::move(boxes), true); }

// Of what is visible, in the order of the scene.
void sort_instances(benchmark::State& state, Boxes boxes) {
    cull_instances(boxes.batches, boxes.spheres, boxes.frame);
    std::vector<uint64_t> keys, scratch;
    const auto unsorted = [&] {
        std::vector<uint32_t> visible = boxes.frame.visible.instances;
        std::ranges::sort(visible);
        std::vector<uint64_t> result;
        for (const uint32_t i : visible) {
            result.push_back(draw_key(static_cast<float>(boxes.frame.setup.camera.eye.z - boxes.spheres.z[i]), i));
        }
        return result;
    }();
    for (auto _ : state) {
        keys = unsorted;
        sort_draw_keys(keys, scratch);
        benchmark::DoNotOptimize(keys.data());
        benchmark::ClobberMemory();
    }
}

// Of what is visible, by walls that fill a checkerboard of squares of 64 px, halfway into the cube.
class Hider {
  public:
    explicit Hider(const FrameSetup& setup) {
        for (int y = 0; y < kTilesY; ++y) {
            for (int x = 0; x < kTilesX; ++x) {
                const bool wall = (x / 4 + y / 4) % 2 == 0;
                farthest_.push_back(wall ? static_cast<float>(setup.camera.eye.z + kHalfExtent / 2.0) : 1e30F);
            }
        }
    }

    void find_hidden(const Boxes& boxes) {
        const FrameSetup& setup = boxes.frame.setup;
        const CameraBasis basis = camera_basis(setup.camera);
        const auto view_sphere = [&](uint32_t i) {
            return glm::vec4(glm::vec3(basis.to_view(boxes.bounds[i].center - setup.camera.eye)), kBoxRadius);
        };
        spheres_.resize(boxes.frame.visible.instances.size());
        std::ranges::transform(boxes.frame.visible.instances, spheres_.begin(), view_sphere);
        hidden_.resize(spheres_.size());
        pyramid_.build(farthest_, kTilesX, kTilesY);
        find_hidden_spheres(spheres_, setup, pyramid_, kTilePx, hidden_);
        benchmark::DoNotOptimize(hidden_.data());
        benchmark::ClobberMemory();
    }

    void count(benchmark::State& state) const {
        state.counters["visible"] = static_cast<double>(hidden_.size());
        state.counters["hidden"] = static_cast<double>(std::ranges::count(hidden_, uint8_t{1}));
    }

  private:
    static constexpr int kTilePx = OcclusionCuller::kTilePx, kTilesX = 1280 / kTilePx, kTilesY = 720 / kTilePx;
    std::vector<float> farthest_;
    std::vector<glm::vec4> spheres_;
    std::vector<uint8_t> hidden_;
    DepthPyramid pyramid_;
};

void find_hidden(benchmark::State& state, Boxes boxes) {
    cull_instances(boxes.batches, boxes.spheres, boxes.frame);
    Hider hider(boxes.frame.setup);
    for (auto _ : state) hider.find_hidden(boxes);
    hider.count(state);
}

// All that the CPU leaves out of one frame, with lights among the boxes, half of them spots.
void whole_frame(benchmark::State& state, Boxes boxes) {
    std::vector<Light> lights(kLights);
    Random random(2);
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].kind = i % 2 == 0 ? LightKind::point : LightKind::spot;
        for (int k = 0; k < 3; ++k) lights[i].position[k] = random.uniform(-kHalfExtent, kHalfExtent);
    }
    Hider hider(boxes.frame.setup);
    for (auto _ : state) {
        cull_instances(boxes.batches, boxes.spheres, boxes.frame);
        collect_lights(lights, boxes.frame);
        hider.find_hidden(boxes);
    }
    hider.count(state);
    state.counters["lights"] = static_cast<double>(boxes.frame.lights.size());
}

}  // namespace

void add_culling_stages() {
    constexpr int64_t kCount = 100'000;
    const auto add = [](const std::string& stage, void (*body)(benchmark::State&, Boxes)) {
        for (const auto& [eye, distance] : {std::pair("inside", 0.0), std::pair("outside", 4.0 * kHalfExtent)}) {
            add_benchmark("culling/" + stage + "/" + eye + ":" + std::to_string(kCount), [=, distance = distance](
                                                                                             benchmark::State& state) {
                body(state, scattered_boxes(kCount, distance));
                state.SetItemsProcessed(state.iterations() * kCount);
            })->Unit(benchmark::kMicrosecond);
        }
    };
    add("cull_instances", cull_instances_alone);
    add("cull_and_sort_instances", cull_and_sort);
    add("sort_instances", sort_instances);
    add("find_hidden", find_hidden);
    add("whole_frame", whole_frame);
}

}  // namespace lightsweep
