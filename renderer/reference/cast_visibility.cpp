#include "renderer/reference/cast_visibility.h"

#include "renderer/reference/triangle.h"
#include "renderer/reference/view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr int kBandRows = 64;

// Rows [top, bottom) of the picture, and the distance of what was seen there so far.
struct Band {
    int top, bottom;
    std::vector<double> nearest;
};

struct PixelRange {
    int left = 0, right = 0, top = 0, bottom = 0;  // the second of each exclusive
};

class Caster {
  public:
    Caster(const Scene& scene, const Camera& camera, int width, int height)
        : scene_(scene), camera_(camera), view_(camera, width, height) {}

    Visibility run() {
        visible_.width = view_.width();
        visible_.height = view_.height();
        visible_.triangles.resize(static_cast<size_t>(view_.width()) * static_cast<size_t>(view_.height()));
        const int bands = (view_.height() + kBandRows - 1) / kBandRows;
        tbb::parallel_for(0, bands, [&](int i) {
            Band band{.top = i * kBandRows, .bottom = std::min((i + 1) * kBandRows, view_.height()), .nearest = {}};
            band.nearest.assign(static_cast<size_t>(view_.width()) * kBandRows, std::numeric_limits<double>::max());
            cast(band);
        });
        return std::move(visible_);
    }

  private:
    void cast(Band& band) {
        for (uint32_t i = 0; i < scene_.instances.size(); ++i) {
            const Mesh& mesh = scene_.meshes[scene_.instances[i].mesh];
            const PlacedInstance placed = place(scene_.instances[i], camera_.eye);
            const bool double_sided = scene_.materials[mesh.material].double_sided;
            for (uint32_t t = 0; t < mesh.index_count / 3; ++t) {
                const PlacedTriangle triangle(corners(scene_, mesh, t), placed);
                const double facing = -glm::dot(glm::cross(triangle.edge1, triangle.edge2), triangle.corner);
                if (double_sided || (placed.mirrored ? -facing : facing) > 0.0) cast(triangle, {i, t}, band);
            }
        }
    }

    // The ray is inside when it is on the same side of the three planes through the eye and an edge.
    void cast(const PlacedTriangle& triangle, VisibleTriangle id, Band& band) {
        const glm::dvec3 v[3] = {triangle.corner, triangle.at(1.0, 0.0), triangle.at(0.0, 1.0)};
        const PixelRange range = pixels(v, band);
        if (range.left >= range.right || range.top >= range.bottom) return;
        const glm::dvec3 planes[3] = {glm::cross(v[1], v[2]), glm::cross(v[2], v[0]), glm::cross(v[0], v[1])};
        const double volume = glm::dot(v[0], planes[0]);
        for (int y = range.top; y < range.bottom; ++y) {
            for (int x = range.left; x < range.right; ++x) {
                const glm::dvec3 ray = view_.ray(x, y);
                const double a = glm::dot(ray, planes[0]), b = glm::dot(ray, planes[1]), c = glm::dot(ray, planes[2]);
                const bool inside = (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
                const double distance = volume / (a + b + c);  // along the view axis
                if (!inside || !(distance >= camera_.near_distance && distance <= camera_.far_distance)) continue;
                const auto column = static_cast<size_t>(x);
                const auto width = static_cast<size_t>(view_.width());
                double& nearest = band.nearest[static_cast<size_t>(y - band.top) * width + column];
                if (distance >= nearest) continue;
                nearest = distance;
                visible_.triangles[static_cast<size_t>(y) * width + column] = id;
            }
        }
    }

    // Whose rays may meet the triangle: all of the band when a vertex cannot be projected.
    PixelRange pixels(const glm::dvec3 (&vertices)[3], const Band& band) const {
        glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
        for (const glm::dvec3& vertex : vertices) {
            if (view_.distance(vertex) <= 1e-3 * camera_.near_distance)
                return {0, view_.width(), band.top, band.bottom};
            low = glm::min(low, view_.window(vertex));
            high = glm::max(high, view_.window(vertex));
        }
        const auto pixel = [](double at, int first, int last) {
            return static_cast<int>(std::clamp(at, static_cast<double>(first), static_cast<double>(last)));
        };
        return {pixel(low.x - 1.0, 0, view_.width()), pixel(high.x + 1.0, 0, view_.width()),
                pixel(low.y - 1.0, band.top, band.bottom), pixel(high.y + 1.0, band.top, band.bottom)};
    }

    const Scene& scene_;
    const Camera& camera_;
    View view_;
    Visibility visible_;
};

}  // namespace

Visibility cast_visibility(const Scene& scene, const Camera& camera, int width, int height) {
    return Caster(scene, camera, width, height).run();
}

}  // namespace lightsweep
