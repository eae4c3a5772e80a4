// Every metric of two images at once: what a cell and `lightsweep diff` report.
#pragma once

#include "bench/metrics/metrics.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace lightsweep {

struct ImageError {
    std::vector<std::optional<double>> values;  ///< as all_metrics()
    /// Every value equals its counterpart, or both are NaN.
    bool identical = false;

    /// The metric `key`, which must be one of the table ("rmse").
    std::optional<double> value(std::string_view key) const;
};

/// Throws InputError as require_comparable() does.
ImageError compare_images(const Image& reference, const Image& test);

/// {"rmse": ..., ..., "identical": ...}; a metric that is not defined is null.
nlohmann::ordered_json to_json(const ImageError& error);

}  // namespace lightsweep
