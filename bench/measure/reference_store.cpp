#include "bench/measure/reference_store.h"

#include "renderer/gl/draw.h"
#include "renderer/paths/probes.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

// Calls visit(index of the pixel from the top row, index of the texel from the bottom row) for every pixel.
template <class Visit>
void for_each_pixel(int width, int height, Visit visit) {
    for (int y = 0; y < height; ++y) {
        const size_t top = static_cast<size_t>(y) * width, bottom = static_cast<size_t>(height - 1 - y) * width;
        for (size_t x = 0; x < static_cast<size_t>(width); ++x) visit(top + x, bottom + x);
    }
}

glm::vec3 rgb_of(const std::vector<float>& rgba, size_t texel) {
    return {rgba[4 * texel], rgba[4 * texel + 1], rgba[4 * texel + 2]};
}

}  // namespace

Visibility draw_visibility(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes) {
    const PathSetup setup{.needs = subject.scene.needs(), .layout = {}, .hdr = {}};
    const VisibleTrianglePath probe = build_visible_triangles(setup);
    Arm arm(probe.path, setup, subject, buffers, shapes);
    arm.draw();
    const auto read = [&](TargetId target) { return arm.path().texture(target).read_floats(4); };

    Visibility result{.width = subject.width, .height = subject.height, .triangles = {}, .texels = {}};
    result.triangles.resize(static_cast<size_t>(subject.width) * subject.height);
    const auto ids = arm.path().texture(probe.triangles).read_uints(2);
    for_each_pixel(result.width, result.height, [&](size_t pixel, size_t texel) {
        // 0, the cleared value, becomes kNoSurface.
        result.triangles[pixel] = {.instance = ids[2 * texel] - 1, .triangle = ids[2 * texel + 1]};
    });
    if (!setup.needs.textures()) return result;
    const auto base = read(probe.base_color_roughness), normal = read(probe.normal_metallic);
    const auto emissive = read(probe.emissive);
    result.texels.resize(result.triangles.size());
    for_each_pixel(result.width, result.height, [&](size_t pixel, size_t texel) {
        result.texels[pixel] = {.base_color = rgb_of(base, texel),
                                .roughness = base[4 * texel + 3],
                                .normal = rgb_of(normal, texel),
                                .metallic = normal[4 * texel + 3],
                                .emissive = rgb_of(emissive, texel)};
    });
    return result;
}

void ReferenceStore::look_at(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes) {
    const Scene& scene = subject.scene.scene();
    const std::string view = fmt::format("{} {}x{}", scene.content_hash, subject.width, subject.height);
    if (view == view_) return;
    visibility_ = draw_visibility(subject, buffers, shapes);
    surfaces_ = reference_surfaces(scene, scene.camera, visibility_);
    view_ = view;
}

Reference ReferenceStore::reference(const Subject& subject, int subpixel_bits) const {
    const int64_t start = now_ns();
    const Scene& scene = subject.scene.scene();
    const int width = subject.width, height = subject.height;
    Reference result;
    result.key = reference_key(scene, scene.camera, subject.lights, visibility_, subpixel_bits);
    auto found = cache_.find(result.key, width, height);
    result.from_cache = found.has_value();
    if (found) {
        result.hdr = std::move(*found);
    } else {
        const auto snapped = subpixel_bits == 0 ? std::vector<ReferenceSurface>{}
                                                : reference_surfaces(scene, scene.camera, visibility_, subpixel_bits);
        result.hdr = to_image(shade_reference(scene, subpixel_bits == 0 ? surfaces_ : snapped, width, height,
                                              scene.camera, subject.lights),
                              width, height);
        cache_.store(result.key, result.hdr);
    }
    result.display = tone_mapped(result.hdr);
    result.seconds = static_cast<double>(now_ns() - start) * 1e-9;
    return result;
}

}  // namespace lightsweep
