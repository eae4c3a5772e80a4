// Error metrics: pure functions of two images, one file each, one row each in metrics.cpp. Knows no GL.
#pragma once

#include "bench/metrics/image_pair.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace lightsweep {

/// One or a few numbers that say how far the test picture is from the reference. Zero on equal pictures (a similarity:
/// one; a ratio such as PSNR: nothing). Non-finite pixels are left out of every metric but `nonfinite_px`, which counts
/// them and is reported beside.
struct Metric {
    std::string_view key;  ///< the file's name, the command line's word
    std::string_view summary;
    std::span<const std::string_view> values;  ///< the JSON keys of its numbers, their unit at the end
    /// As many as `values`. Nothing where a number is not defined, never NaN or infinity.
    std::vector<std::optional<double>> (*measure)(const ImagePair& pair);
};

/// In the order of the table, which is the order in reports.
std::span<const Metric* const> all_metrics();

/// The keys of every metric's numbers, in that order.
std::vector<std::string_view> metric_value_keys();

}  // namespace lightsweep
