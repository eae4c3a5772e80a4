// How far a cell's picture and its G-buffer are from what they should be. Pure functions of images and numbers.
#pragma once

#include "bench/measure/surface_probes.h"
#include "bench/metrics/flip.h"
#include "bench/report/record.h"
#include "renderer/reference/surfaces.h"

#include <span>
#include <vector>

namespace lightsweep {

/// What an arm shows, as the metrics take it.
struct Picture {
    Image hdr;
    Image display;  ///< tone_mapped(hdr): no rounding to 8 bits hides what a layout loses
};

Picture picture_of(Image hdr);

/// Every metric of both pictures, HDR-FLIP among them only if asked: it takes longer than all the others.
enum class HdrFlip : uint8_t { measure, leave_out };
PictureError picture_error(const Picture& truth, const Picture& test, HdrFlip hdr_flip);

/// <e, p> / <e, e> over display values, e = test - reference, p = test - control; nothing when e is zero everywhere.
std::optional<double> packing_share(const Image& reference, const Image& control, const Image& test);

/// Ends of the interval (level 0.95) of the map's mean, as if the means of its 8 x 8 equal regions were independent
/// samples: how much the number hangs on what the picture happens to show. Nothing for maps below 8 pixels a side.
struct MeanInterval {
    double low = 0.0, high = 0.0;
};
std::optional<MeanInterval> mean_interval(const FlipMap& map);

/// |v - r| / |r| by the pixels' largest channels, over the pixels that a surface covers and light reaches. A pixel that
/// is not finite counts among those above 1e-4 and nowhere else.
RelativeError relative_error(const Image& reference, const Image& test, std::span<const ReferenceSurface> surfaces);

/// The errors of a layout's fields, over the pixels that both take for covered and whose decoded values are finite.
struct LayoutError {
    /// normal (degrees), position (relative to its distance), base_color, specular, roughness, metallic (absolute,
    /// largest channel), emissive (relative, over the pixels that shine). Fields that the scene does not need are left
    /// out.
    std::vector<FieldError> fields;
    int64_t lost_px = 0;  ///< the other pixels that either takes for covered
};

LayoutError layout_error(std::span<const ReferenceSurface> truth, std::span<const DecodedSurface> decoded,
                         const SceneNeeds& needs);

}  // namespace lightsweep
