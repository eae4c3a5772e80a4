#include "bench/measure/reference_store.h"

#include "renderer/reference/reference.h"

#include <fmt/format.h>

namespace lightsweep {

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
