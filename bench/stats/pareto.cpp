#include "bench/stats/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lightsweep {

std::vector<size_t> pareto_front(std::span<const TimeAndError> points) {
    std::vector<size_t> order;
    for (size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].time) && std::isfinite(points[i].error)) order.push_back(i);
    std::ranges::sort(order, {}, [&](size_t i) { return std::tuple(points[i].time, points[i].error, i); });

    std::vector<size_t> front;
    for (const size_t i : order) {
        const auto equals_last = [&] {
            return points[i].time == points[front.back()].time && points[i].error == points[front.back()].error;
        };
        if (front.empty() || points[i].error < points[front.back()].error || equals_last()) front.push_back(i);
    }
    return front;
}

}  // namespace lightsweep
