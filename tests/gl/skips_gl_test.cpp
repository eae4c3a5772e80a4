// What must hold for every skip: the picture with it is the picture without it, for every path and scene, wherever the
// camera is, inside geometry and lights too, and however it jumps from one frame to the next.
#include "renderer/base/hash.h"
#include "renderer/gl/context.h"
#include "tests/gl/fixture.h"
#include "tests/gl/unruly_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <ostream>

namespace lightsweep {
namespace {

constexpr int kWidth = 96, kHeight = 54, kLights = 20;
// Every skip sees this many cameras at least, over all paths that it concerns and all scenes.
constexpr size_t kCamerasPerSkip = 200;
// Shaders take long to compile: each skip is tried in a share of all pairs of path and scene, every path and every
// scene among them. LIGHTSWEEP_TEST_ALL_SKIPS=1 tries all.
constexpr size_t kShare = 4;
// A sliver's side is decided twice, before clipping in floats and after it on the rasteriser's grid: what culling calls
// a back face may be a front face to the shader.
constexpr size_t kSliverPx = 3;
// Of surfaces at the same depth the first one drawn shows. With 24 bits two surfaces that cross have some such pixels.
constexpr size_t kTiePx = 2;
// Where shaders are compiled anew, the compiler may fuse the same operations in another way.
constexpr double kRelative = 1e-5, kAbsolute = 1e-6;

struct Case {
    std::string scene, path;
    std::string layout = "float32", hdr = "rgba32f";
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " " << c.path; }

CellParams cell_of(const Case& c, SkipSet skips) {
    CellParams cell;
    cell.scene = c.scene;
    cell.path = c.path;
    if (find_path(c.path).uses_layout) cell.layout = c.layout;
    if (find_path(c.path).uses_light_lists) cell.light_lists = "cpu";
    cell.hdr = c.hdr;
    cell.skip = skips.text();
    return cell;
}

// Of the format, for as many sums as there are lights.
double rounding_of(const std::string& hdr) {
    if (hdr == "rgba32f") return kRelative;
    return kLights * (hdr == "rgba16f" ? 0x1p-10 : 0x1p-5);
}

class EverySkip : public testing::TestWithParam<Case> {
  protected:
    EverySkip()
        : scene(scenes.scene(GetParam().scene)),
          subject{scenes.gpu_scene(GetParam().scene), unruly_lights(scene, kLights, 5), kWidth, kHeight} {
        // Lights that give nothing.
        subject.lights[2].radius = 0.0;
        subject.lights[3].color = glm::dvec3(0.0);
        subject.lights[4].position += glm::dvec3(1e4);
    }

    std::unique_ptr<Arm> arm(SkipSet skips) {
        return std::make_unique<Arm>(cell_of(GetParam(), skips), subject, buffers, shapes);
    }

    Image picture(Arm& arm) {
        arm.draw();
        return arm.hdr_image();
    }

    void expect_same(const Image& without, Image with, bool same_bits, size_t odd_pixels, const std::string& what) {
        const bool strict = same_bits && gl::Context::current()->info().software;
        const double relative = strict ? 0.0 : rounding_of(GetParam().hdr), absolute = strict ? 0.0 : kAbsolute;
        for (size_t i = 0; i < with.rgb.size() && odd_pixels > 0; i += 3) {
            const auto differ = [&](size_t k) {
                return std::abs(with.rgb[k] - without.rgb[k]) > relative * std::abs(without.rgb[k]) + absolute;
            };
            if (!differ(i) && !differ(i + 1) && !differ(i + 2)) continue;
            std::copy_n(&without.rgb[i], 3, &with.rgb[i]);
            --odd_pixels;
        }
        expect_close(without, with, relative, absolute, what);
    }

    SceneStore scenes;
    const Scene& scene;
    Subject subject;
    FrameBuffers buffers;
    DrawShapes shapes;
};

// Every path and every scene with each format of the HDR target, with depth in 32 bits, reversed, and in 24, standard.
std::vector<Case> every_scene_and_path() {
    const auto scenes = resource_keys("scenes", ".json"), paths = path_keys();
    std::vector<Case> cases;
    for (size_t s = 0; s < scenes.size(); ++s) {
        for (size_t p = 0; p < paths.size(); ++p) {
            cases.push_back({.scene = scenes[s],
                             .path = paths[p],
                             .layout = (s + p) % 3 == 1 ? "lecture" : "float32",
                             .hdr = kHdrFormats[(s + p / 3) % kHdrFormats.size()]});
        }
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySkip, testing::ValuesIn(every_scene_and_path()),
                         [](const auto& c) { return c.param.scene + "_" + c.param.path; });

size_t paths_concerned(Skip skip) {
    if (skip == Skip::light_lists) return 4;
    if (skip == Skip::light_depth) return 3;
    return skip == Skip::background ? 6 : path_keys().size();
}

size_t odd_pixels(Skip skip) {
    const bool reorders = skip == Skip::sort || skip == Skip::occlusion || skip == Skip::frustum;
    if (reorders) return EverySkip::GetParam().layout == "float32" ? 0 : kTiePx;
    return skip == Skip::backface ? kSliverPx : 0;
}

// Not by the passes: the frame holds less.
bool decided_by_frame(Skip skip) { return skip == Skip::frustum || skip == Skip::light_frustum || skip == Skip::sort; }

TEST_P(EverySkip, LeavesThePictureAsItIs) {
    const auto scene_keys = resource_keys("scenes", ".json"), paths = path_keys();
    const size_t share = std::getenv("LIGHTSWEEP_TEST_ALL_SKIPS") == nullptr ? kShare : 1,
                 scene_count = scene_keys.size();
    const auto place = [](const std::vector<std::string>& keys, const std::string& key) {
        return static_cast<size_t>(std::ranges::find(keys, key) - keys.begin());
    };
    const size_t pair = place(scene_keys, GetParam().scene) + place(paths, GetParam().path);
    const auto everything = arm(SkipSet::all());
    for (const auto& info : skip_infos()) {
        if (info.skip == Skip::cells) continue;  // draws nothing otherwise
        if ((pair + static_cast<size_t>(info.skip)) % share != 0) continue;
        const auto without = arm(SkipSet::all().without(info.skip));
        if (everything->path().text() == without->path().text() && !decided_by_frame(info.skip)) continue;
        Random random(hash_bytes(info.key));
        const size_t cameras = share * kCamerasPerSkip / (scene_count * paths_concerned(info.skip)) + 2;
        for (size_t i = 0; i < cameras; ++i) {
            subject.camera = i == 0 ? scene.camera : unruly_camera(scene, random);
            expect_same(picture(*without), picture(*everything), info.same_bits, odd_pixels(info.skip),
                        std::string(info.key) + ", camera " + std::to_string(i));
        }
    }
}

TEST_P(EverySkip, AllOfThemLeaveItToo) {
    const auto all = arm(SkipSet::all()), none = arm(SkipSet::none());
    Random random(77);
    for (int i = 0; i < 4; ++i) {
        subject.camera = i == 0 ? scene.camera : unruly_camera(scene, random);
        expect_same(picture(*none), picture(*all), false, kSliverPx + kTiePx, "camera " + std::to_string(i));
    }
}

}  // namespace
}  // namespace lightsweep
