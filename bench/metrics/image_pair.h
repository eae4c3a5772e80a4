// Two pictures of one size, in the values that the metrics' definitions ask for. Knows no files.
#pragma once

#include "renderer/image/image.h"

namespace lightsweep {

/// Both pictures twice: linear radiance, and display values in [0, 1].
struct ImagePair {
    Image reference_linear, test_linear;
    Image reference_display, test_display;
    bool hdr = false;  ///< the linear ones are the originals: FLIP is HDR-FLIP, max_abs is of linear values

    int width() const { return reference_linear.width; }
    int height() const { return reference_linear.height; }
};

/// From two images as they come: a linear one is shown by the sRGB curve and clamped to [0, 1]; `hdr` when the
/// reference is linear. Throws InputError unless both have one size.
ImagePair image_pair(const Image& reference, const Image& test);

}  // namespace lightsweep
