#include "bench/metrics/image_error.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {

std::optional<double> ImageError::value(std::string_view key) const {
    const auto metrics = all_metrics();
    const auto found = std::ranges::find(metrics, key, [](const Metric* metric) { return metric->key; });
    CHECK_THAT(found != metrics.end(), "no metric '{}'", key);
    return values[static_cast<size_t>(found - metrics.begin())];
}

ImageError compare_images(const Image& reference, const Image& test) {
    require_comparable(reference, test);
    ImageError error;
    for (const Metric* metric : all_metrics()) error.values.push_back(metric->measure(reference, test));
    error.identical = std::ranges::equal(reference.rgb, test.rgb,
                                         [](float r, float v) { return r == v || (std::isnan(r) && std::isnan(v)); });
    return error;
}

nlohmann::ordered_json to_json(const ImageError& error) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    const auto metrics = all_metrics();
    for (size_t i = 0; i < metrics.size(); ++i) {
        auto& member = json[std::string(metrics[i]->key)];
        if (error.values[i] && std::isfinite(*error.values[i])) member = *error.values[i];
    }
    json["identical"] = error.identical;
    return json;
}

}  // namespace lightsweep
