#include "bench/metrics/image_pair.h"

#include "bench/metrics/reduce.h"
#include "renderer/base/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace lightsweep {
namespace {

/// Row by row, each on the core that is free.
template <typename Curve>
Image each_value(const Image& image, ColorSpace space, Curve curve) {
    Image result(image.width, image.height, space);
    const auto row = 3 * static_cast<size_t>(image.width);
    tbb::parallel_for(0, image.height, [&](int y) {
        const float* from = image.pixel(0, y);
        std::transform(from, from + row, result.pixel(0, y), curve);
    });
    return result;
}

/// To [0, 1]; what is not finite stays, so that it is counted.
float clamped(float v) { return is_finite(v) ? std::clamp(v, 0.0F, 1.0F) : v; }

void take(const Image& image, Image& linear, Image& display) {
    if (image.space == ColorSpace::linear) {
        linear = image;
        display = each_value(image, ColorSpace::display, [](float v) { return clamped(linear_to_srgb(v)); });
    } else {
        display = each_value(image, ColorSpace::display, clamped);
        linear = each_value(display, ColorSpace::linear, srgb_to_linear);
    }
}

}  // namespace

ImagePair image_pair(const Image& reference, const Image& test) {
    if (reference.width != test.width || reference.height != test.height)
        throw InputError(
            fmt::format("the images differ in size: reference {}x{}, test {}x{}; both must have the same size",
                        reference.width, reference.height, test.width, test.height));
    ImagePair pair;
    take(reference, pair.reference_linear, pair.reference_display);
    take(test, pair.test_linear, pair.test_display);
    pair.hdr = reference.space == ColorSpace::linear;
    return pair;
}

}  // namespace lightsweep
