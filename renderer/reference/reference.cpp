#include "renderer/reference/reference.h"

#include "renderer/base/check.h"
#include "renderer/reference/lights.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <numeric>

namespace lightsweep {
namespace {

// Lights are sifted twice: once for a block, once for each of its tiles.
constexpr int kTile = 8;
constexpr int kBlock = 64;
static_assert(kTile * kTile == kLanes);

struct Area {
    int x, y, right, bottom;  // in pixels, the last two exclusive
};

// What one thread works with.
struct Workspace {
    LambertLanes lambert;
    BlinnPhongLanes blinn_phong;
    GgxLanes ggx;
    IncidentLanes incident;
    std::vector<uint32_t> of_block, of_tile;  // lights
};

class Shading {
  public:
    Shading(const Scene& scene, std::span<const ReferenceSurface> surfaces, int width, int height,
            std::vector<PlacedLight> lights)
        : scene_(scene),
          surfaces_(surfaces),
          width_(width),
          height_(height),
          lights_(std::move(lights)),
          all_lights_(lights_.size()),
          radiance_(surfaces.size()) {
        std::iota(all_lights_.begin(), all_lights_.end(), 0U);
    }

    std::vector<glm::dvec3> run() {
        const int columns = (width_ + kBlock - 1) / kBlock;
        const int rows = (height_ + kBlock - 1) / kBlock;
        // On the heap: the lanes of all models are more than a stack frame should hold.
        tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces(
            [] { return std::make_unique<Workspace>(); });
        tbb::parallel_for(0, columns * rows, [&](int block) {
            const int x = block % columns * kBlock, y = block / columns * kBlock;
            shade_block(clipped(x, y, kBlock), *workspaces.local());
        });
        return std::move(radiance_);
    }

  private:
    Area clipped(int x, int y, int size) const {
        return {x, y, std::min(x + size, width_), std::min(y + size, height_)};
    }

    template <typename Visit>
    void for_pixels(const Area& area, Visit visit) const {
        for (int y = area.y; y < area.bottom; ++y)
            for (int x = area.x; x < area.right; ++x)
                visit(static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x));
    }

    Bounds bounds(const Area& area) const {
        Bounds box;
        for_pixels(area, [&](size_t pixel) {
            if (surfaces_[pixel].covered) box.include(surfaces_[pixel].position);
        });
        return box;
    }

    void shade_block(const Area& block, Workspace& work) {
        lights_reaching(lights_, all_lights_, bounds(block), work.of_block);
        for (int y = block.y; y < block.bottom; y += kTile)
            for (int x = block.x; x < block.right; x += kTile) shade_tile(clipped(x, y, kTile), work);
    }

    void shade_tile(const Area& tile, Workspace& work) {
        lights_reaching(lights_, work.of_block, bounds(tile), work.of_tile);
        work.lambert.count = work.blinn_phong.count = work.ggx.count = 0;
        for_pixels(tile, [&](size_t pixel) {
            const ReferenceSurface& s = surfaces_[pixel];
            if (!s.covered) return;
            visit_lanes(s.model, work, [&](auto& lanes) { lanes.add(s, scene_.ambient); });
        });
        const auto light_all = [&](auto& lanes) {
            if (lanes.count == 0) return;
            for (const uint32_t index : work.of_tile) {
                light_lanes(lights_[index], lanes, work.incident);
                reflect(lanes, work.incident, lights_[index].color);
            }
            lanes.count = 0;  // they are taken out again in the order in which they came
        };
        light_all(work.lambert);
        light_all(work.blinn_phong);
        light_all(work.ggx);
        for_pixels(tile, [&](size_t pixel) {
            const ReferenceSurface& s = surfaces_[pixel];
            radiance_[pixel] = scene_.background;
            if (!s.covered) return;
            visit_lanes(s.model, work, [&](auto& lanes) { radiance_[pixel] = lanes.radiance.get(lanes.count++); });
        });
    }

    template <typename Visit>
    static void visit_lanes(ShadingModel model, Workspace& work, Visit visit) {
        switch (model) {
            case ShadingModel::ggx:
                return visit(work.ggx);
            case ShadingModel::blinn_phong:
                return visit(work.blinn_phong);
            case ShadingModel::lambert:
                return visit(work.lambert);
        }
    }

    const Scene& scene_;
    std::span<const ReferenceSurface> surfaces_;
    int width_, height_;
    std::vector<PlacedLight> lights_;
    std::vector<uint32_t> all_lights_;
    std::vector<glm::dvec3> radiance_;
};

}  // namespace

std::vector<glm::dvec3> shade_reference(const Scene& scene, std::span<const ReferenceSurface> surfaces, int width,
                                        int height, const Camera& camera, std::span<const Light> lights) {
    CHECK_THAT(width >= 0 && height >= 0 && surfaces.size() == static_cast<size_t>(width) * static_cast<size_t>(height),
               "{} surfaces for {}x{} pixels", surfaces.size(), width, height);
    return Shading(scene, surfaces, width, height, place_lights(lights, camera.eye)).run();
}

Image to_image(std::span<const glm::dvec3> radiance, int width, int height) {
    Image image(width, height, ColorSpace::linear);
    CHECK_THAT(radiance.size() == image.pixel_count(), "{} values for {}x{} pixels", radiance.size(), width, height);
    for (size_t i = 0; i < radiance.size(); ++i)
        for (int c = 0; c < 3; ++c) image.rgb[3 * i + static_cast<size_t>(c)] = static_cast<float>(radiance[i][c]);
    return image;
}

}  // namespace lightsweep
