// The picture of an error: where two images differ, and how much. Knows no files and no GL.
#pragma once

#include "renderer/image/image.h"

namespace lightsweep {

/// A display image of the largest channel's absolute difference per pixel, in magma's colours on a logarithmic scale:
/// the largest difference of the two images is the brightest, a ten-thousandth of it and everything below is black, so
/// that a single wild pixel does not hide the rest. A pixel that is not finite in either image is green. Throws
/// InputError as require_comparable() does.
Image error_map(const Image& reference, const Image& test);

}  // namespace lightsweep
