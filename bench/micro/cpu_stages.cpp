#include "bench/metrics/image_error.h"
#include "bench/micro/guarded.h"
#include "bench/micro/stages.h"
#include "bench/micro/synthetic_journal.h"
#include "bench/report/assemble.h"
#include "bench/report/report_file.h"
#include "bench/stats/ratio.h"
#include "renderer/base/random.h"
#include "renderer/gbuffer/layout_glsl.h"
#include "renderer/image/codecs.h"
#include "renderer/scene/scene.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace lightsweep {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

// --- Lights ---

void add_light_stages() {
    static constexpr std::array<std::pair<Placement, const char*>, 3> kPlacements{
        {{Placement::grid, "grid"}, {Placement::random, "random"}, {Placement::surface, "surface"}}};
    for (const auto& [placement, word] : kPlacements) {
        for (const int count : {1 << 10, 1 << 12, 1 << 14, 1 << 16}) {
            const auto body = [placement = placement, count](benchmark::State& state) {
                Scene scene = load_scene("atrium");
                scene.lights.generator->placement = placement;
                for (auto _ : state) benchmark::DoNotOptimize(make_lights(scene, count, {}));
                state.SetItemsProcessed(state.iterations() * count);
            };
            add_benchmark(std::string("lights/") + word + "/" + std::to_string(count), body)
                ->Unit(benchmark::kMicrosecond);
        }
    }
}

// --- Layouts ---

void add_layout_stages() {
    for (const std::string& key : layout_keys()) {
        const auto load = [key](benchmark::State& state) {
            for (auto _ : state) benchmark::DoNotOptimize(load_layout(key));
            state.SetItemsProcessed(state.iterations());
        };
        add_benchmark("layout/load/" + key, load)->Unit(benchmark::kMicrosecond);
        const auto generate = [key](benchmark::State& state) {
            const Layout layout = load_layout(key);
            for (auto _ : state) benchmark::DoNotOptimize(layout_glsl(layout));
            state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(layout_glsl(layout).size()));
        };
        add_benchmark("layout/glsl/" + key, generate)->Unit(benchmark::kMicrosecond);
    }
}

// --- Images ---

// A wall lit by the cornell box's lights, in linear radiance: smooth, coloured, every mantissa bit in use, as a render.
const Image& lit_wall() {
    static const Image image = [] {
        const auto lights = make_lights(load_scene("cornell"), 32, {});
        Image result(kWidth, kHeight, ColorSpace::linear);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const glm::dvec3 point(2.0 * x / kWidth - 1.0, 2.0 - 2.0 * y / kHeight, -1.0);
                glm::dvec3 radiance(0.0);
                for (const Light& light : lights) {
                    const glm::dvec3 to_light = light.position - point;
                    const double square = glm::dot(to_light, to_light);
                    radiance += light.color * to_light.z / (square * std::sqrt(square));
                }
                for (int c = 0; c < 3; ++c) result.pixel(x, y)[c] = static_cast<float>(radiance[c]);
            }
        }
        return result;
    }();
    return image;
}

// The same after storage in 16-bit floats.
Image in_half(Image image) {
    for (float& v : image.rgb) v = glm::unpackHalf1x16(glm::packHalf1x16(v));
    return image;
}

void add_image_stage(const std::string& name, ColorSpace space,
                     std::string (*encode)(const Image&, const std::string&)) {
    const auto body = [=](benchmark::State& state) {
        const Image image = converted(lit_wall(), space);
        for (auto _ : state) benchmark::DoNotOptimize(encode(image, name));
        state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(image.pixel_count()));
        state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(image.rgb.size() * sizeof(float)));
        state.counters["file_bytes"] = static_cast<double>(encode(image, name).size());
    };
    add_benchmark("image/" + name + "/1280x720", body)->Unit(benchmark::kMillisecond)->UseRealTime();
}

// A metric on the linear images is HDR-FLIP, and on those of a display LDR-FLIP; what else differs is only the curve.
void add_metric_stage(const std::string& name, ColorSpace space, const std::function<void(const ImagePair&)>& measure) {
    const auto body = [=](benchmark::State& state) {
        const ImagePair pair = image_pair(converted(lit_wall(), space), converted(in_half(lit_wall()), space));
        for (auto _ : state) measure(pair);
        state.SetItemsProcessed(state.iterations() * int64_t{kWidth} * kHeight);
    };
    // Metrics run on all cores: only the wall clock sees all of their work.
    add_benchmark("metric/" + name + "/1280x720", body)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void add_metric_stages() {
    const auto all = [](const ImagePair& pair) { benchmark::DoNotOptimize(measure_error(pair)); };
    for (const auto& [word, space] : {std::pair("ldr", ColorSpace::display), std::pair("hdr", ColorSpace::linear)}) {
        for (const Metric* metric : all_metrics())
            add_metric_stage(word + ("/" + std::string(metric->key)), space,
                             [metric](const ImagePair& pair) { benchmark::DoNotOptimize(metric->measure(pair)); });
        add_metric_stage(word + std::string("/all"), space, all);
    }
    const auto pair = [](benchmark::State& state) {
        const Image reference = lit_wall(), test = in_half(reference);
        for (auto _ : state) benchmark::DoNotOptimize(image_pair(reference, test));
        state.SetItemsProcessed(state.iterations() * int64_t{kWidth} * kHeight);
    };
    add_benchmark("metric/image_pair/1280x720", pair)->Unit(benchmark::kMillisecond)->UseRealTime();
}

// --- Reports and statistics ---

void add_report_stages() {
    constexpr int kGroups = 25;  // 200 cells
    constexpr int kFrames = 100;
    const auto assemble = [](benchmark::State& state) {
        const JournalContent journal = synthetic_journal(kGroups, kFrames);
        for (auto _ : state) benchmark::DoNotOptimize(assemble_report(journal));
        state.SetItemsProcessed(state.iterations() * kGroups * kSyntheticArms);
    };
    add_benchmark("report/assemble", assemble)->Unit(benchmark::kMillisecond);

    const auto serialise = [](benchmark::State& state) {
        const Json report = assemble_report(synthetic_journal(kGroups, kFrames));
        for (auto _ : state) benchmark::DoNotOptimize(report_text(report));
        state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(report_text(report).size()));
    };
    add_benchmark("report/serialise", serialise)->Unit(benchmark::kMillisecond);

    const auto parse = [](benchmark::State& state) {
        const std::string text = report_text(assemble_report(synthetic_journal(kGroups, kFrames)));
        for (auto _ : state) benchmark::DoNotOptimize(parse_report(Json::parse(text), "report"));
        state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text.size()));
    };
    add_benchmark("report/parse", parse)->Unit(benchmark::kMillisecond);
}

void add_statistics_stages() {
    for (const size_t count : {100, 1000}) {
        const auto body = [count](benchmark::State& state) {
            Random random(1);
            std::vector<double> a(count), b(count);
            for (size_t i = 0; i < count; ++i) {
                const double drift = 1.0 + 0.3 * std::sin(0.2 * static_cast<double>(i));
                a[i] = 1e7 * drift * random.uniform(0.95, 1.05);
                b[i] = 1.1e7 * drift * random.uniform(0.95, 1.05);
            }
            for (auto _ : state) benchmark::DoNotOptimize(ratio_of_pairs(a, b));
            state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(count));
        };
        add_benchmark("stats/ratio_of_pairs/" + std::to_string(count), body)->Unit(benchmark::kMicrosecond);
    }
}

}  // namespace

void add_cpu_stages() {
    add_light_stages();
    add_layout_stages();
    add_image_stage("encode_png", ColorSpace::display, encode_png);
    add_image_stage("encode_exr", ColorSpace::linear, encode_exr);
    add_metric_stages();
    add_report_stages();
    add_statistics_stages();
}

}  // namespace lightsweep
