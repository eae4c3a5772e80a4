// Error metrics: pure functions of two images, one file each, one row each in metrics.cpp. Knows no GL.
#pragma once

#include "renderer/image/image.h"

#include <optional>
#include <span>
#include <string_view>

namespace lightsweep {

/// One number that says how far `test` is from `reference`. Zero on equal images (a ratio such as PSNR: nothing).
/// Non-finite pixels are left out of every metric but `nonfinite_px`, which counts them and is reported beside.
struct Metric {
    std::string_view key;  ///< the file's name, the JSON key, the command line's word; its unit at the end
    std::string_view summary;
    /// The images have passed require_comparable(). Nothing where the metric is not defined, never NaN or infinity.
    std::optional<double> (*measure)(const Image& reference, const Image& test);
};

/// In the order of the table, which is the order in reports.
std::span<const Metric* const> all_metrics();

/// Throws InputError unless both have the same size and the same colour space.
void require_comparable(const Image& reference, const Image& test);

}  // namespace lightsweep
