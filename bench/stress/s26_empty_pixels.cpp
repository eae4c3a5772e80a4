// Pixels without a surface, around things and in the holes of an alpha mask, under bright lights, with whatever the
// frame before left in the G-buffer: they show the background, bit by bit, and all others do not.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"

#include <fmt/format.h>

#include <memory>

namespace lightsweep {
namespace {

constexpr int kSizePx = 48;

// Squares that are there and squares that are not, smoothed over a texel between.
Texture holes() {
    constexpr int kTexels = 16, kSquare = 4;
    Texture texture{.name = "holes", .width = kTexels, .height = kTexels, .srgb = true, .rgba = {}};
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            const bool hole = (x / kSquare + y / kSquare) % 2 == 1;
            texture.rgba.insert(texture.rgba.end(), {230, 150, 60, static_cast<uint8_t>(hole ? 0 : 255)});
        }
    }
    return texture;
}

// A lattice before a ball. What they reflect has more red than blue; the background has less, in numbers that every
// format holds exactly.
Scene lattice() {
    Scene scene;
    scene.key = "lattice";
    scene.background = {0.25, 0.5, 1.0};
    scene.ambient = glm::dvec3(0.1);
    scene.textures.push_back(holes());
    add_instance(scene, make_shape(SphereShape{.radius = 0.6}),
                 {.name = "ball", .base_color = {0.9F, 0.4F, 0.1F}, .roughness = 0.4F});
    glm::dmat4 before(1.0);
    before[3] = {0.3, -0.2, 1.0, 1.0};
    add_instance(
        scene, make_shape(QuadShape{.size = glm::dvec2(1.6)}),
        {.name = "lattice", .roughness = 0.5F, .base_color_texture = 0, .alpha_cutoff = 0.5F, .double_sided = true},
        before);
    scene.camera = {.eye = {0.5, 0.4, 3.2}, .target = glm::dvec3(0.0)};
    scene.lights.fixed = {point_light({1.0, 1.0, 2.0}, 20.0, glm::dvec3(90.0)),
                          point_light({-1.0, 0.0, -1.0}, 3.0, glm::dvec3(40.0)),
                          spot_light({0.0, 2.0, 2.5}, {0.0, -1.0, -1.0}, 8.0, 45.0, glm::dvec3(50.0)),
                          sun({0.3, -1.0, -0.5}, glm::dvec3(2.0))};
    return scene;
}

// What one view leaves in the targets lies under the other's background.
struct View {
    Camera camera;
    std::vector<ReferenceSurface> surfaces;
};

std::vector<View> views(Drawing& drawing) {
    Camera close = drawing.scene().camera;
    close.eye = {-0.4, 0.1, 1.7};
    std::vector<View> result;
    for (const Camera& camera : {close, drawing.scene().camera}) {
        drawing.set_camera(camera);
        result.push_back({camera, drawing.surfaces()});
    }
    result.push_back(result.front());
    return result;
}

void count_wrong_pixels(const View& view, const Image& image, const glm::dvec3& background, StressMeasurement& found) {
    found.non_finite += count_non_finite(image);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float* rgb = image.pixel(x, y);
            const bool empty = glm::dvec3(rgb[0], rgb[1], rgb[2]) == background;
            if (view.surfaces[static_cast<size_t>(y) * image.width + x].covered != empty) continue;
            found.error += 1.0;
            found.where = fmt::format("pixel ({}, {}): {}", x, y, empty ? "a surface is lost" : "sky is lit");
        }
    }
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const SkipSet skips = arm.get("skip", "all") == "all" ? SkipSet::all() : SkipSet::none();
    const auto drawing = std::make_shared<Drawing>(bench, arm, lattice(), kSizePx, kSizePx, skips);
    return [drawing, tried = views(*drawing)](double) {
        StressMeasurement found;
        for (const View& view : tried) {
            drawing->set_camera(view.camera);
            count_wrong_pixels(view, drawing->draw(), drawing->scene().background, found);
        }
        return found;
    };
}

std::vector<ArmBlock> arms() {
    ArmBlock with_skips = every_path();
    with_skips.push_back({"skip", {"all", "none"}});
    return {with_skips, every_layout()};
}

}  // namespace

extern const StressCase stress_empty_pixels{
    .id = "S26",
    .summary = "pixels without a surface, around things and in the holes of an alpha mask, over an older frame",
    .measures = "pixels that should show the background and do not, or the other way round",
    .unit = "count",
    .bound = 0.0,
    .bound_source = "the background is written as it is",
    .failure = "the sky glows near lights, and masks have bright or dark rims",
    .arms = arms,
    .begin = begin};

}  // namespace lightsweep
