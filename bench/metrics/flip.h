// FLIP: how much of a difference a person sees who flips between two pictures. Pure functions, on all cores.
// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", HPG 2020; Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in Rendered High Dynamic Range
// Images", Eurographics 2021 (short papers).
#pragma once

#include "bench/metrics/image_pair.h"

#include <filesystem>
#include <vector>

namespace lightsweep {

/// 0.7 m from a display 0.7 m and 3840 pixels wide: 0.7 * 3840 / 0.7 * pi / 180.
inline constexpr double kPixelsPerDegree = 67.0206432765823;

/// Exposures of HDR-FLIP, in stops: `count` of them from `start` to `stop`, evenly spread. LDR: count 0.
struct FlipExposures {
    double start = 0.0;
    double stop = 0.0;
    int count = 0;
};

struct FlipMap {
    int width = 0;
    int height = 0;
    std::vector<float> error;  ///< per pixel, [0, 1]; NaN where a pixel is not finite in either picture
    FlipExposures exposures;
};

/// LDR-FLIP of two pictures of display values in [0, 1].
FlipMap ldr_flip(const Image& reference_display, const Image& test_display,
                 double pixels_per_degree = kPixelsPerDegree);

/// HDR-FLIP of two linear pictures: per pixel the largest LDR-FLIP over the exposures that the reference needs.
FlipMap hdr_flip(const Image& reference_linear, const Image& test_linear, double pixels_per_degree = kPixelsPerDegree);

/// HDR- or LDR-FLIP, as the pair asks.
FlipMap flip(const ImagePair& pair, double pixels_per_degree = kPixelsPerDegree);

/// The map as numbers for other programs: a 16-bit grey PNG of 65535 times the error, rounded; 0 where it is NaN.
/// Throws InputError.
void write_flip_map(const FlipMap& map, const std::filesystem::path& file);

/// A display image of the map in magma's colours, 0 black to 1 white; pixels that are not finite are green.
Image flip_picture(const FlipMap& map);

}  // namespace lightsweep
