// SSIM: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity",
// IEEE Transactions on Image Processing 13, 2004, with their constants and window, on luma. In double precision: the
// variances are small differences of large means. Only windows that lie within the picture count, and hold no pixel
// that is not finite.
#include "bench/metrics/metrics.h"
#include "bench/metrics/reduce.h"
#include "bench/metrics/row_filter.h"

#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr int kRadius = 5;
constexpr double kDeviation = 1.5;
constexpr double kC1 = 0.01 * 0.01;  // (K1 L)^2 with L = 1
constexpr double kC2 = 0.03 * 0.03;

RowFilter<double> window() {
    RowFilter<double> filter;
    double sum = 0;
    for (int k = 0; k <= kRadius; ++k) {
        filter.weights.push_back(std::exp(-k * k / (2 * kDeviation * kDeviation)));
        sum += (k == 0 ? 1 : 2) * filter.weights.back();
    }
    for (double& weight : filter.weights) weight /= sum;
    return filter;
}

/// Rec. ITU-R BT.601.
double luma(const float* v) { return 0.299 * v[0] + 0.587 * v[1] + 0.114 * v[2]; }

/// Of one row, whose pixels that are not finite in either picture are NaN in both.
void take_luma(const ImagePair& pair, int y, double* r, double* v) {
    for (int x = 0; x < pair.width(); ++x) {
        const float* reference = pair.reference_display.pixel(x, y);
        const float* test = pair.test_display.pixel(x, y);
        const bool finite = all_finite({reference, 3}) && all_finite({test, 3});
        r[x] = finite ? luma(reference) : std::numeric_limits<double>::quiet_NaN();
        v[x] = finite ? luma(test) : std::numeric_limits<double>::quiet_NaN();
    }
}

struct Sum {
    double similarity = 0;
    uint64_t windows = 0;
};

/// The windows whose upper rows are [first, end).
Sum of_windows(const ImagePair& pair, const RowFilter<double>& filter, int first, int end) {
    enum { kR, kV, kRR, kVV, kRV, kMoments };
    const int width = pair.width();
    const int valid = width - 2 * kRadius;
    const int rows = end - first + 2 * kRadius;
    Rows<double> moments(kMoments, width + kRowBlock), means(kMoments, valid);
    std::vector<Rows<double>> along(kMoments, Rows<double>(rows, valid));
    const double* taps[2 * kRadius + 1];
    const double* const* middle = taps + kRadius;
    for (int row = 0; row < rows; ++row) {
        double *r = moments[kR], *v = moments[kV], *rr = moments[kRR], *vv = moments[kVV], *rv = moments[kRV];
        take_luma(pair, first + row, r, v);
        for (int x = 0; x < width; ++x) rr[x] = r[x] * r[x], vv[x] = v[x] * v[x], rv[x] = r[x] * v[x];
        for (int m = 0; m < kMoments; ++m) {
            for (int k = 0; k <= 2 * kRadius; ++k) taps[k] = moments[m] + k;
            filter.apply(middle, along[static_cast<size_t>(m)][row], valid);
        }
    }
    Sum sum;
    for (int y = 0; y < end - first; ++y) {
        for (int m = 0; m < kMoments; ++m) {
            for (int k = 0; k <= 2 * kRadius; ++k) taps[k] = along[static_cast<size_t>(m)][y + k];
            filter.apply(middle, means[m], valid);
        }
        for (int x = 0; x < valid; ++x) {
            const double r = means[kR][x], v = means[kV][x];
            const double both = means[kRV][x] - r * v;
            const double each = (means[kRR][x] - r * r) + (means[kVV][x] - v * v);
            const double similarity = (2 * r * v + kC1) * (2 * both + kC2) / ((r * r + v * v + kC1) * (each + kC2));
            if (std::isnan(similarity)) continue;
            sum.similarity += similarity;
            ++sum.windows;
        }
    }
    return sum;
}

std::vector<std::optional<double>> ssim(const ImagePair& pair) {
    constexpr int kWindow = 2 * kRadius + 1;
    if (pair.width() < kWindow || pair.height() < kWindow) return {std::nullopt};
    const RowFilter<double> filter = window();
    const Sum sum = reduce_blocks<Sum>(
        pair.height() - kWindow + 1, [&](int first, int end) { return of_windows(pair, filter, first, end); },
        [](Sum a, Sum b) {
            return Sum{a.similarity + b.similarity, a.windows + b.windows};
        });
    if (sum.windows == 0) return {std::nullopt};
    return {sum.similarity / static_cast<double>(sum.windows)};
}

constexpr std::string_view kValues[] = {"ssim"};

}  // namespace

extern const Metric metric_ssim{
    .key = "ssim",
    .summary = "structural similarity of the luma of display values; 1 without a difference",
    .values = kValues,
    .measure = ssim};

}  // namespace lightsweep
