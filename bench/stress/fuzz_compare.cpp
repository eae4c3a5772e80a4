#include "bench/stress/fuzz_compare.h"

#include "bench/stats/quantile.h"
#include "bench/stress/vector_math.h"
#include "renderer/base/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

glm::dvec3 pixel_of(const Image& image, size_t i) {
    return {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]};
}

}  // namespace

HdrRounding hdr_rounding(const std::string& hdr) {
    if (hdr == "rgba32f") return {.relative = 0x1p-23, .step = 1e-30, .largest = 3.4e38};
    if (hdr == "rgba16f") return {.relative = 0x1p-10, .step = 0x1p-24, .largest = 65504.0};
    CHECK_THAT(hdr == "r11g11b10f", "{}", hdr);
    return {.relative = 0x1p-5, .step = 0x1p-14, .largest = 64512.0};
}

PictureFaults find_faults(const Image& image, const BoundedRadiance& exact, const std::vector<bool>& judged,
                          const std::vector<bool>& may_saturate, const HdrRounding& hdr, int roundings) {
    PictureFaults faults;
    double worst_excess = 0.0;
    const double lost = 1.0 - roundings * hdr.relative;
    for (size_t i = 0; i < exact.radiance.size(); ++i) {
        const glm::dvec3 shown = pixel_of(image, i), right = exact.radiance[i];
        const double bound = kExplained * exact.movement[i] + kArithmetic * largest(right);
        const bool on_the_way = !may_saturate.empty() && may_saturate[i];
        bool saturated = false, wrong = false, no_number = false;
        double excess = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double allowed = bound + roundings * (hdr.relative * right[c] + hdr.step);
            const bool beyond = on_the_way || right[c] + allowed >= hdr.largest * lost || !judged[i];
            // Infinity is what a 16-bit format makes of too much.
            if (std::isnan(shown[c]) || (std::isinf(shown[c]) && !(beyond && hdr.largest < 1e6))) {
                no_number = true;
                continue;
            }
            if (!judged[i]) continue;
            const double error = std::abs(shown[c] - right[c]);
            if (error <= allowed) continue;
            if (on_the_way || (beyond && shown[c] >= 0.9 * hdr.largest * lost)) {
                saturated = true;
                continue;
            }
            wrong = true;
            excess = std::max(excess, error / allowed);
        }
        faults.judged += judged[i];
        faults.non_finite += no_number;
        faults.wrong += wrong;
        faults.saturated += saturated;
        if (saturated) faults.largest_exact = std::max(faults.largest_exact, largest(right));
        if (wrong) worst_excess = std::max(worst_excess, excess);
        if ((wrong && excess == worst_excess) || (no_number && faults.worst.empty())) {
            const auto width = static_cast<size_t>(image.width);
            faults.worst = fmt::format("pixel ({}, {}) is ({:.6g}, {:.6g}, {:.6g}), not ({:.6g}, {:.6g}, {:.6g})",
                                       i % width, i / width, shown.x, shown.y, shown.z, right.x, right.y, right.z);
            if (wrong) faults.worst += fmt::format(", {:.3g} times its bound off", excess);
        }
    }
    return faults;
}

double relative_error_quantile(const Image& image, std::span<const glm::dvec3> exact, const std::vector<bool>& judged,
                               double darkest, double q) {
    std::vector<double> errors;
    for (size_t i = 0; i < exact.size(); ++i) {
        const glm::dvec3 shown = pixel_of(image, i);
        const double scale = largest(exact[i]);
        if (judged[i] && scale > darkest && is_finite(shown)) errors.push_back(largest(shown - exact[i]) / scale);
    }
    return errors.empty() ? 0.0 : quantile(errors, q);
}

}  // namespace lightsweep
