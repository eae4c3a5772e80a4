#include "bench/stats/nonnegative_fit.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr int kMaxSweeps = 20'000;
constexpr double kConverged = 1e-12;  // change of a coefficient's contribution, relative to the largest one

}  // namespace

std::vector<double> nonnegative_fit(std::span<const std::vector<double>> rows, std::span<const double> b) {
    CHECK_THAT(rows.size() == b.size(), "{} rows, {} values", rows.size(), b.size());
    const size_t columns = rows.empty() ? 0 : rows.front().size();
    // Columns of unit length: coefficients of any unit converge alike.
    std::vector<double> length(columns, 0.0);
    for (const auto& row : rows) {
        CHECK_THAT(row.size() == columns, "{} and {} columns", row.size(), columns);
        for (size_t j = 0; j < columns; ++j) length[j] += row[j] * row[j];
    }
    for (double& l : length) l = std::sqrt(l);
    std::vector<std::vector<double>> gram(columns, std::vector<double>(columns, 0.0));
    std::vector<double> gradient(columns, 0.0);  // of x = 0
    for (size_t r = 0; r < rows.size(); ++r) {
        for (size_t j = 0; j < columns; ++j) {
            if (length[j] == 0.0) continue;
            gradient[j] -= rows[r][j] / length[j] * b[r];
            for (size_t k = 0; k < columns; ++k) {
                if (length[k] > 0.0) gram[j][k] += rows[r][j] / length[j] * (rows[r][k] / length[k]);
            }
        }
    }
    std::vector<double> x(columns, 0.0);
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
        double largest_change = 0.0, largest = 0.0;
        for (size_t j = 0; j < columns; ++j) {
            if (length[j] == 0.0) continue;
            const double next = std::max(0.0, x[j] - gradient[j] / gram[j][j]);
            const double change = next - x[j];
            for (size_t k = 0; k < columns; ++k) gradient[k] += change * gram[k][j];
            x[j] = next;
            largest_change = std::max(largest_change, std::abs(change));
            largest = std::max(largest, next);
        }
        if (largest_change <= kConverged * largest) break;
    }
    for (size_t j = 0; j < columns; ++j) x[j] = length[j] > 0.0 ? x[j] / length[j] : 0.0;
    return x;
}

}  // namespace lightsweep
