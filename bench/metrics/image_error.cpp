#include "bench/metrics/image_error.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {

std::optional<double> ImageError::value(std::string_view key) const {
    const auto keys = metric_value_keys();
    const auto found = std::ranges::find(keys, key);
    CHECK_THAT(found != keys.end(), "no metric gives '{}'", key);
    return values[static_cast<size_t>(found - keys.begin())];
}

ImageError measure_error(const ImagePair& pair, std::string_view without) {
    ImageError error;
    for (const Metric* metric : all_metrics()) {
        const auto values =
            metric->key == without ? std::vector<std::optional<double>>(metric->values.size()) : metric->measure(pair);
        CHECK_THAT(values.size() == metric->values.size(), "{} gave {} numbers", metric->key, values.size());
        error.values.insert(error.values.end(), values.begin(), values.end());
    }
    const auto same = [](const Image& reference, const Image& test) {
        return std::ranges::equal(reference.rgb, test.rgb,
                                  [](float r, float v) { return r == v || (std::isnan(r) && std::isnan(v)); });
    };
    error.identical = same(pair.reference_linear, pair.test_linear) && same(pair.reference_display, pair.test_display);
    return error;
}

nlohmann::ordered_json to_json(const ImageError& error) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    const auto keys = metric_value_keys();
    for (size_t i = 0; i < keys.size(); ++i) {
        auto& member = json[std::string(keys[i])];
        if (error.values[i] && std::isfinite(*error.values[i])) member = *error.values[i];
    }
    json["identical"] = error.identical;
    return json;
}

}  // namespace lightsweep
