// The reference of a group: what its cells should show. Draws the visibility pass, computes the surfaces and the
// picture in double precision, and keeps pictures on disk between runs.
#pragma once

#include "bench/measure/cell_error.h"
#include "renderer/reference/cache.h"
#include "renderer/reference/surfaces.h"

#include <string>
#include <vector>

namespace lightsweep {

struct Reference {
    Picture picture;
    std::string key;
    bool from_cache = false;
    double seconds = 0.0;
};

class ReferenceStore {
  public:
    explicit ReferenceStore(ReferenceCache cache = {}) : cache_(std::move(cache)) {}

    /// Looks at the subject's scene from its camera: what follows is about this view. Cheap when it is the one before.
    void look_at(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes);

    /// The surface under each pixel of the view.
    const std::vector<ReferenceSurface>& surfaces() const { return surfaces_; }
    /// The lit picture of the view. `subpixel_bits` as in reference_surfaces().
    Reference reference(const Subject& subject, int subpixel_bits = 0) const;

  private:
    ReferenceCache cache_;
    std::string view_;  ///< the scene's content and the size that the rest is of
    Visibility visibility_;
    std::vector<ReferenceSurface> surfaces_;
};

}  // namespace lightsweep
