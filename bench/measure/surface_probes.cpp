#include "bench/measure/surface_probes.h"

#include "renderer/paths/probes.h"

namespace lightsweep {
namespace {

// A probe's targets are read when the frame is over: they must be kept.
constexpr SkipSet kProbeSkips = SkipSet::all().without(Skip::clears);

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

float alpha_of(const std::vector<float>& rgba, size_t texel) { return rgba[4 * texel + 3]; }

}  // namespace

Visibility draw_visibility(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes,
                           const Layout& layout, SkipSet skips) {
    PathSetup setup{.needs = subject.scene.needs(), .layout = {}, .hdr = {}, .skips = skips.without(Skip::clears)};
    setup.layout.depth = layout.depth;
    setup.layout.convention = layout.convention;
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
                                .roughness = alpha_of(base, texel),
                                .normal = rgb_of(normal, texel),
                                .metallic = alpha_of(normal, texel),
                                .emissive = rgb_of(emissive, texel)};
    });
    return result;
}

std::vector<DecodedSurface> draw_decoded_surface(PathSetup setup, const Subject& subject, FrameBuffers& buffers,
                                                 const DrawShapes& shapes) {
    setup.skips = kProbeSkips;
    const DecodedSurfacePath probe = build_decoded_surface(setup);
    Arm arm(probe.path, setup, subject, buffers, shapes);
    arm.draw();
    const auto read = [&](TargetId target) { return arm.path().texture(target).read_floats(4); };
    const auto position = read(probe.position_roughness), normal = read(probe.normal_metallic);
    const auto color = read(probe.base_color_covered), specular = read(probe.specular), emissive = read(probe.emissive);
    std::vector<DecodedSurface> surfaces(color.size() / 4);
    for_each_pixel(subject.width, subject.height, [&](size_t pixel, size_t texel) {
        surfaces[pixel] = {.position = rgb_of(position, texel),
                           .normal = rgb_of(normal, texel),
                           .base_color = rgb_of(color, texel),
                           .specular = rgb_of(specular, texel),
                           .emissive = rgb_of(emissive, texel),
                           .roughness = alpha_of(position, texel),
                           .metallic = alpha_of(normal, texel),
                           .covered = alpha_of(color, texel) > 0.5F};
    });
    return surfaces;
}

}  // namespace lightsweep
