// Every metric of two images at once: what a cell and `lightsweep diff` report.
#pragma once

#include "bench/metrics/metrics.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace lightsweep {

struct ImageError {
    std::vector<std::optional<double>> values;  ///< as metric_value_keys()
    /// Every value equals its counterpart, or both are NaN.
    bool identical = false;

    /// The number `key`, which must be one of the table's ("rmse").
    std::optional<double> value(std::string_view key) const;
};

/// The numbers of the metric `without`, if any, stay undefined: HDR-FLIP takes as long as all the others together, ten
/// times over.
ImageError measure_error(const ImagePair& pair, std::string_view without = {});

/// {"rmse": ..., ..., "identical": ...}; a number that is not defined is null.
nlohmann::ordered_json to_json(const ImageError& error);

}  // namespace lightsweep
