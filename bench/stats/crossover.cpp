#include "bench/stats/crossover.h"

#include "renderer/base/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace lightsweep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One measured light count: logarithms of the ratio and its ends.
struct Point {
    double x, middle, low, high;
    /// -1 where a is faster beyond the noise, +1 where b is, 0 where the interval holds 1.
    int winner() const { return (low > 0) - (high < 0); }
};

/// Where the straight line of `curve` from `from` to `to` passes zero; the values differ in sign, `to` may be infinite.
double zero_between(const Point& from, const Point& to, double Point::*curve) {
    return std::lerp(from.x, to.x, from.*curve / (from.*curve - to.*curve));
}

/// Where the interval begins to hold 1 on the way from `clear` to its neighbour.
double edge_of_noise(const Point& clear, const Point& neighbour) {
    return zero_between(clear, neighbour, clear.winner() > 0 ? &Point::low : &Point::high);
}

/// Where the ratio passes 1, rising. Points that lie on 1 belong to the change around them.
std::vector<double> changes_of(std::span<const Point> points) {
    std::vector<double> changes;
    std::optional<size_t> last;  // the last point off 1
    for (size_t i = 0; i < points.size(); ++i) {
        if (points[i].middle == 0) continue;
        if (last && (points[*last].middle > 0) != (points[i].middle > 0))
            changes.push_back(i == *last + 1 ? zero_between(points[*last], points[i], &Point::middle)
                                             : std::midpoint(points[*last + 1].x, points[i - 1].x));
        last = i;
    }
    return changes;
}

/// The stretch in which the two change places: between two clear points, or one of them and an end of what was
/// measured.
struct Stretch {
    std::optional<size_t> left, right;
};

}  // namespace

Crossover find_crossover(std::span<const double> lights, std::span<const Interval> ratios, std::string_view a,
                         std::string_view b) {
    CHECK_THAT(lights.size() == ratios.size(), "{} light counts, {} ratios", lights.size(), ratios.size());
    CHECK(std::ranges::adjacent_find(lights, std::greater_equal<>()) == lights.end());
    CHECK(lights.empty() || lights.front() >= 0);
    if (lights.size() < 2) return {.lights = {}, .statement = "a crossing needs two light counts or more"};

    const double shift = lights.front() == 0 ? 1 : 0;
    std::vector<Point> points;
    for (size_t i = 0; i < lights.size(); ++i)
        points.push_back({.x = std::log2(lights[i] + shift),
                          .middle = std::log(ratios[i].estimate),
                          .low = std::log(ratios[i].low.value_or(0)),
                          .high = std::log(ratios[i].high.value_or(kInfinity))});

    std::vector<size_t> clear, flips;  // flips: positions in `clear` after which the winner is another
    for (size_t i = 0; i < points.size(); ++i) {
        if (points[i].winner() == 0) continue;
        if (!clear.empty() && points[clear.back()].winner() != points[i].winner()) flips.push_back(clear.size() - 1);
        clear.push_back(i);
    }
    const auto name_of = [&](size_t i) { return points[i].winner() < 0 ? a : b; };
    if (clear.empty())
        return {.lights = {},
                .statement = fmt::format("{} and {} cannot be told apart at any light count measured", a, b)};

    Stretch stretch;
    if (flips.size() % 2 == 1) {
        stretch = {.left = clear[flips.front()], .right = clear[flips.back() + 1]};
    } else if (flips.empty() && changes_of(points).size() % 2 == 1) {
        const auto off = std::ranges::find_if(points, [](const Point& p) { return p.middle != 0; });
        if ((off->middle < 0) == (points[clear.front()].winner() < 0)) {
            stretch.left = clear.back();
        } else {
            stretch.right = clear.front();
        }
    } else if (flips.empty()) {
        const bool everywhere = clear.size() == points.size();
        return {.lights = {},
                .statement = fmt::format("{} is faster at every light count {}", name_of(clear.front()),
                                         everywhere ? "measured" : "where the difference exceeds the noise")};
    } else {
        return {.lights = {},
                .statement = fmt::format("{} is faster at both ends, {} between {:g} and {:g} lights",
                                         name_of(clear.front()), name_of(clear[flips.front() + 1]),
                                         lights[clear[flips.front()]], lights[clear[flips.back() + 1]])};
    }

    const size_t first = stretch.left.value_or(0), last = stretch.right.value_or(points.size() - 1);
    const std::vector<double> changes = changes_of(std::span(points).subspan(first, last - first + 1));
    const auto lights_at = [&](double x) { return std::exp2(x) - shift; };
    Interval crossing{.estimate = lights_at(changes[changes.size() / 2]), .low = {}, .high = {}};
    if (stretch.left) crossing.low = lights_at(edge_of_noise(points[first], points[first + 1]));
    if (stretch.right) crossing.high = lights_at(edge_of_noise(points[last], points[last - 1]));
    const auto left_name = stretch.left ? name_of(first) : name_of(last) == a ? b : a;
    return {.lights = crossing,
            .statement = fmt::format("{} is faster below about {:.3g} lights{}, {} above{}", left_name,
                                     crossing.estimate, stretch.left ? "" : " (within the noise)",
                                     left_name == a ? b : a, stretch.right ? "" : " (within the noise)")};
}

}  // namespace lightsweep
