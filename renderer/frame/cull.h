// Which spheres a view may show, many at once, and instances front to back. Pure functions of arrays; know no GL.
#pragma once

#include "renderer/frame/frame.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lightsweep {

/// How far single precision may move things, relative to their distance from the eye and their size. A unit is 2^-24.
/// ViewVolume rounds a sphere's distance to a plane by less than 16: differences, products with the plane's normal and
/// their sums by a unit each. Shaders move a vertex by less than 16 on its way from the world to the picture; what they
/// take from it before that is in instance_bounds. All of that, twice. Rasterisers move vertices too, to 1/256 of a
/// pixel: that adds nothing, since the outermost pixel centres are half a pixel inside the view.
inline constexpr float kCullMargin = 0x1p-18F;

/// Spheres relative to the eye, along world axes. Arrays, for vector code.
struct SphereChunk {
    static constexpr size_t kCapacity = 512;
    std::array<float, kCapacity> x, y, z, radius;
    // What ViewVolume::test says of them.
    std::array<float, kCapacity> distance;   ///< of the centre, along the view
    std::array<uint32_t, kCapacity> inside;  ///< 1 where the view may show a part, else 0
};

/// What a camera sees: between its near and far planes and the four sides of its picture.
class ViewVolume {
  public:
    /// `margin`: spheres are grown by this part of their distance and radius.
    explicit ViewVolume(const FrameSetup& setup, float margin = kCullMargin);
    /// Tests the first `count` spheres. What is no number is inside.
    void test(SphereChunk& spheres, size_t count) const;

  private:
    glm::vec3 right_, up_, forward_;
    float sin_x_, cos_x_, sin_y_, cos_y_;  // of half the angles of view
    float near_, far_;
    float margin_;
};

/// Makes `frame.visible` of the instances that `frame.setup` asks for, and counts them. `spheres`: of the batches'
/// instances in their order (GpuScene::batch_spheres).
void cull_instances(std::span<const Batch> batches, const SphereArrays& spheres, Frame& frame);

/// A number to sort by: the view distance of a sphere's centre in front of an index that orders those equally far. What
/// is centred behind the eye is nearest. (The nearest points would put all large things first, in no order.)
uint64_t draw_key(float distance, uint32_t index);
inline uint32_t index_of_key(uint64_t key) { return static_cast<uint32_t>(key); }

/// Sorts keys whose indices rise. `scratch` is memory to work in.
void sort_draw_keys(std::vector<uint64_t>& keys, std::vector<uint64_t>& scratch);

}  // namespace lightsweep
