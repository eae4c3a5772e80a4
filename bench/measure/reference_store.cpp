#include "bench/measure/reference_store.h"

#include "renderer/reference/reference.h"

#include <fmt/format.h>

namespace lightsweep {

void ReferenceStore::look_at(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes) {
    const Scene& scene = subject.scene.scene();
    const std::string view = fmt::format("{} {}x{}", scene.content_hash, subject.width, subject.height);
    if (view == view_) return;
    view_.clear();  // should one of the next two throw, the rest is of no view
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
    if (!found) {
        const auto snapped = subpixel_bits == 0 ? std::vector<ReferenceSurface>{}
                                                : reference_surfaces(scene, scene.camera, visibility_, subpixel_bits);
        found = to_image(shade_reference(scene, subpixel_bits == 0 ? surfaces_ : snapped, width, height, scene.camera,
                                         subject.lights),
                         width, height);
        cache_.store(result.key, *found);
    }
    result.picture = picture_of(std::move(*found));
    result.seconds = static_cast<double>(now_ns() - start) * 1e-9;
    return result;
}

}  // namespace lightsweep
