#include "bench/measure/light_hits.h"

#include "renderer/reference/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lightsweep {
namespace {

constexpr int kMaxCellsPerAxis = 128;
// Smaller cells bound the lights better, and there are more of them to visit.
constexpr double kCellsPerRadius = 2.0;

// Points sorted into the cells of a uniform grid around them.
class PointGrid {
  public:
    PointGrid(std::span<const ReferenceSurface> surfaces, double cell_size);

    size_t size() const { return x_.size(); }
    int64_t count_within(const PlacedLight& light) const;

  private:
    using Cell = std::array<int, 3>;
    Cell cell_of(const glm::dvec3& point) const;
    size_t index_of(const Cell& cell) const {
        return (static_cast<size_t>(cell[2]) * static_cast<size_t>(cells_[1]) + static_cast<size_t>(cell[1])) *
                   static_cast<size_t>(cells_[0]) +
               static_cast<size_t>(cell[0]);
    }
    int64_t count_in_cell(const PlacedLight& light, const Cell& cell) const;

    Bounds bounds_;
    double cell_size_ = 1.0;
    Cell cells_{1, 1, 1};
    std::vector<size_t> begin_;  // of each cell's points, and the end of the last one's
    std::vector<double> x_, y_, z_;
};

PointGrid::PointGrid(std::span<const ReferenceSurface> surfaces, double cell_size) {
    size_t count = 0;
    for (const auto& surface : surfaces) {
        if (!surface.covered) continue;
        bounds_.include(surface.position);
        ++count;
    }
    if (count == 0) return;
    const glm::dvec3 extent = bounds_.size();
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-9});
    cell_size_ = std::clamp(cell_size, longest / kMaxCellsPerAxis, longest);
    for (int axis = 0; axis < 3; ++axis) {
        cells_[static_cast<size_t>(axis)] =
            std::clamp(static_cast<int>(std::ceil(extent[axis] / cell_size_)), 1, kMaxCellsPerAxis);
    }
    // A counting sort by cell.
    begin_.assign(static_cast<size_t>(cells_[0]) * static_cast<size_t>(cells_[1]) * static_cast<size_t>(cells_[2]) + 1,
                  0);
    std::vector<size_t> cell_index;
    cell_index.reserve(count);
    for (const auto& surface : surfaces) {
        if (!surface.covered) continue;
        cell_index.push_back(index_of(cell_of(surface.position)));
        ++begin_[cell_index.back() + 1];
    }
    for (size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    std::vector<size_t> next(begin_.begin(), begin_.end() - 1);
    for (auto* axis : {&x_, &y_, &z_}) axis->resize(count);
    size_t number = 0;
    for (const auto& surface : surfaces) {
        if (!surface.covered) continue;
        const size_t place = next[cell_index[number++]]++;
        x_[place] = surface.position.x;
        y_[place] = surface.position.y;
        z_[place] = surface.position.z;
    }
}

// Points beside the grid get the cell that is nearest.
PointGrid::Cell PointGrid::cell_of(const glm::dvec3& point) const {
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        const double place = std::floor((point[axis] - bounds_.low[axis]) / cell_size_);
        cell[a] = static_cast<int>(std::clamp(place, 0.0, static_cast<double>(cells_[a] - 1)));
    }
    return cell;
}

int64_t PointGrid::count_in_cell(const PlacedLight& light, const Cell& cell) const {
    const size_t index = index_of(cell);
    const size_t first = begin_[index], end = begin_[index + 1];
    if (first == end) return 0;
    const glm::dvec3 p = light.position;
    const double radius2 = light.radius2;
    int64_t count = 0;
    if (light.kind == LightKind::point) {
        for (size_t i = first; i < end; ++i) {
            const double dx = x_[i] - p.x, dy = y_[i] - p.y, dz = z_[i] - p.z;
            count += dx * dx + dy * dy + dz * dz < radius2 ? 1 : 0;
        }
        return count;
    }
    for (size_t i = first; i < end; ++i) {
        const glm::dvec3 way(x_[i] - p.x, y_[i] - p.y, z_[i] - p.z);
        const double distance2 = glm::dot(way, way);
        const bool in_cone = glm::dot(way, light.direction) > light.cos_outer * std::sqrt(distance2);
        count += distance2 < radius2 && in_cone ? 1 : 0;
    }
    return count;
}

int64_t PointGrid::count_within(const PlacedLight& light) const {
    if (size() == 0) return 0;
    if (light.kind == LightKind::directional) return static_cast<int64_t>(size());
    const glm::dvec3 reach(std::sqrt(light.radius2));
    const Cell low = cell_of(light.position - reach), high = cell_of(light.position + reach);
    int64_t count = 0;
    for (int z = low[2]; z <= high[2]; ++z) {
        for (int y = low[1]; y <= high[1]; ++y) {
            for (int x = low[0]; x <= high[0]; ++x) count += count_in_cell(light, {x, y, z});
        }
    }
    return count;
}

double mean_radius(std::span<const PlacedLight> lights) {
    double sum = 0.0;
    int count = 0;
    for (const auto& light : lights) {
        if (light.kind == LightKind::directional) continue;
        sum += std::sqrt(light.radius2);
        ++count;
    }
    return count > 0 ? sum / count : 1.0;
}

}  // namespace

int64_t count_light_hits(std::span<const ReferenceSurface> surfaces, std::span<const Light> lights,
                         const glm::dvec3& eye) {
    const auto placed = place_lights(lights, eye);
    const PointGrid points(surfaces, mean_radius(placed) / kCellsPerRadius);
    int64_t hits = 0;
    for (const auto& light : placed) hits += points.count_within(light);
    return hits;
}

}  // namespace lightsweep
